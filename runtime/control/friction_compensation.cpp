// SPDX-License-Identifier: MIT
#include "runtime/control/friction_compensation.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace dyngen::runtime {

FrictionCompensation::FrictionCompensation(const ControlModel& model, const Eigen::VectorXd& band)
    : friction_(model.friction),
      band_(band),
      lower_(model.joints),
      upper_(model.joints),
      at_velocity_(model.joints) {
  if (!friction_) throw std::invalid_argument("FrictionCompensation: the model has no friction");
  if (band.size() != model.joints || !(band.array() > 0).all() || !band.allFinite()) {
    throw std::invalid_argument(
        fmt::format("FrictionCompensation: band has {} values, expected {} positive ones",
                    band.size(), model.joints));
  }
  friction_(band_.data(), upper_.data());
  const Eigen::VectorXd opposite = -band_;
  friction_(opposite.data(), lower_.data());
}

void FrictionCompensation::add(const double* dq, double* tau) noexcept {
  friction_(dq, at_velocity_.data());
  for (Eigen::Index j = 0; j < band_.size(); ++j) {
    if (std::abs(dq[j]) < band_[j]) {
      const double share = (dq[j] + band_[j]) / (2 * band_[j]);
      tau[j] += (1 - share) * lower_[j] + share * upper_[j];
    } else {
      tau[j] += at_velocity_[j];
    }
  }
}

}  // namespace dyngen::runtime
