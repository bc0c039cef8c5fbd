// SPDX-License-Identifier: MIT
#include "runtime/control/velocity_filter.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace dyngen::runtime {

void VelocityFilterOptions::validate() const {
  if (!(sample_time > 0) || !std::isfinite(sample_time) || !(cutoff_hz > 0)) {
    throw std::invalid_argument(
        fmt::format("VelocityFilter: sample_time is {} s, cutoff_hz {}, expected positive numbers",
                    sample_time, cutoff_hz));
  }
}

VelocityFilter::VelocityFilter(const VelocityFilterOptions& options, const Eigen::VectorXd& q,
                               const Eigen::VectorXd& dq)
    : before_(q), dq_(dq) {
  options.validate();
  if (q.size() != dq.size()) {
    throw std::invalid_argument(
        fmt::format("VelocityFilter: {} positions and {} velocities, "
                    "expected as many of both",
                    q.size(), dq.size()));
  }
  forget_ = std::exp(-2 * std::numbers::pi * options.cutoff_hz * options.sample_time);
  gain_ = (1 - forget_) / options.sample_time;
}

const Eigen::VectorXd& VelocityFilter::update(const double* q) noexcept {
  for (Eigen::Index j = 0; j < dq_.size(); ++j) {
    dq_[j] = forget_ * dq_[j] + gain_ * (q[j] - before_[j]);
    before_[j] = q[j];
  }
  return dq_;
}

}  // namespace dyngen::runtime
