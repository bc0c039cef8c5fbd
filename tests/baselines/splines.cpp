// SPDX-License-Identifier: MIT
#include "tests/baselines/splines.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace dyngen::test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd cubic_splines(const VectorXd& x, double low, double high, int pieces) {
  if (!(low < high)) throw std::invalid_argument("cubic_splines(): expected low < high");
  if (pieces < 1) throw std::invalid_argument("cubic_splines(): expected pieces >= 1");
  MatrixXd columns = MatrixXd::Zero(x.size(), pieces + 3);
  for (Index k = 0; k < x.size(); ++k) {
    const double place = std::clamp((x[k] - low) / (high - low), 0.0, 1.0) * pieces;
    const Index piece = std::min<Index>(static_cast<Index>(place), pieces - 1);
    const double u = place - static_cast<double>(piece), rest = 1 - u;
    columns(k, piece) = rest * rest * rest / 6;
    columns(k, piece + 1) = (4 - 6 * u * u + 3 * u * u * u) / 6;
    columns(k, piece + 2) = (4 - 6 * rest * rest + 3 * rest * rest * rest) / 6;
    columns(k, piece + 3) = u * u * u / 6;
  }
  return columns;
}

VectorXd ridge_solution(const MatrixXd& A, const VectorXd& y, double penalty) {
  if (std::isinf(penalty)) return VectorXd::Zero(A.cols());
  MatrixXd gram = A.transpose() * A;
  gram.diagonal().array() += penalty;
  return gram.ldlt().solve(A.transpose() * y);
}

double penalty_by_validation(const MatrixXd& A, const VectorXd& y, const MatrixXd& checked_A,
                             const VectorXd& checked_y) {
  const double unit = A.squaredNorm() / static_cast<double>(std::max<Index>(1, A.cols()));
  double best = std::numeric_limits<double>::infinity();
  double least = checked_y.squaredNorm();
  for (int step = 0; step <= 24; ++step) {
    const double penalty = unit * std::pow(10.0, 0.5 * step - 6);
    const double squares = (checked_y - checked_A * ridge_solution(A, y, penalty)).squaredNorm();
    if (!(squares < least)) continue;
    least = squares;
    best = penalty;
  }
  return best;
}

}  // namespace dyngen::test
