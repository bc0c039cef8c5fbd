// SPDX-License-Identifier: MIT
#include "runtime/control/gains.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace dyngen::runtime {

void Gains::validate(int joints) const {
  for (const auto& [name, values] : {std::pair{"kp", &kp}, std::pair{"kd", &kd}}) {
    if (values->size() != joints || !values->allFinite() || (values->array() < 0).any()) {
      throw std::invalid_argument(
          fmt::format("Gains: {} has {} values, expected {} finite ones that are not negative",
                      name, values->size(), joints));
    }
  }
}

Gains acceleration_gains(int joints, double bandwidth, double damping) {
  return torque_gains(Eigen::VectorXd::Ones(joints), bandwidth, damping);
}

Gains torque_gains(const Eigen::VectorXd& inertia, double bandwidth, double damping) {
  if (!(bandwidth > 0) || !(damping > 0) || !std::isfinite(bandwidth) || !std::isfinite(damping)) {
    throw std::invalid_argument(fmt::format(
        "gains: bandwidth is {} Hz, damping {}, expected positive numbers", bandwidth, damping));
  }
  if (inertia.size() < 1 || !(inertia.array() > 0).all() || !inertia.allFinite()) {
    throw std::invalid_argument("gains: expected a positive inertia of each joint");
  }
  const double w = 2 * std::numbers::pi * bandwidth;
  return {w * w * inertia, 2 * damping * w * inertia};
}

}  // namespace dyngen::runtime
