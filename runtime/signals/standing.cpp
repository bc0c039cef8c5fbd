// SPDX-License-Identifier: MIT
#include "runtime/signals/standing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Of white noise with a variance of 1: the variance of its differences of order 2k is the central
/// binomial coefficient (4k over 2k).
double variance_of_difference(int order) {
  double binomial = 1;
  for (int i = 1; i <= order; ++i) binomial *= static_cast<double>(order + i) / i;
  return binomial;
}

}  // namespace

double difference_noise(VectorXd x) {
  constexpr int kHighestOrder = 8;
  double least = std::numeric_limits<double>::infinity();
  for (int order = 1; order <= kHighestOrder && x.size() > 1; ++order) {
    x = (x.tail(x.size() - 1) - x.head(x.size() - 1)).eval();
    if (order % 2 != 0) continue;
    const double variance = x.squaredNorm() / static_cast<double>(x.size());
    least = std::min(least, std::sqrt(variance / variance_of_difference(order)));
  }
  return least;
}

bool stands(const Eigen::Ref<const Eigen::MatrixXd>& q) {
  for (Index j = 0; j < q.cols(); ++j) {
    const double range = q.col(j).maxCoeff() - q.col(j).minCoeff();
    if (range > kMovesAbove * difference_noise(q.col(j))) return false;
  }
  return true;
}

}  // namespace dyngen::runtime
