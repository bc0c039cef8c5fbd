// SPDX-License-Identifier: MIT
#include "runtime/evidence/lag_products.h"

#include <algorithm>
#include <utility>

#include "runtime/estimation/burg.h"
#include "runtime/estimation/joint_noise.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::VectorXd;

void LagProducts::add(const VectorXd& e, const VectorXd& counted) {
  for (VectorXd& stretch : stretches_of(e, counted)) stretches_.push_back(std::move(stretch));
  for (Index lag = 0; lag <= std::min(kNoiseLags, e.size() - 1); ++lag) {
    const Index rows = e.size() - lag;
    sums_[lag] += e.tail(rows).dot(e.head(rows));
    pairs_[lag] += counted.tail(rows).dot(counted.head(rows));
  }
}

VectorXd LagProducts::of_pairs() const { return sums_.cwiseQuotient(pairs_.cwiseMax(1)); }

VectorXd LagProducts::covariance() const {
  return autocovariance(autoregression_of(stretches_, kNoiseLags), kNoiseLags);
}

}  // namespace dyngen::runtime
