// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/control/control_model.h"

namespace dyngen::runtime {

/// A model's friction as torque that a controller adds, without chatter at zero velocity.
///
/// Outside |dq| < band it is the model's friction. Inside it is linear in dq between the values at
/// both ends, so that noise of a joint that stands gives torque in proportion and no jumps: at most
/// friction(band) / band per unit of dq. It does not hold for friction that depends on anything but
/// the joint's own velocity.
class FrictionCompensation {
 public:
  /// @param band  (n) rad/s or m/s, positive
  /// @throws std::invalid_argument  if the model has no friction, or band is not n positive values
  FrictionCompensation(const ControlModel& model, const Eigen::VectorXd& band);

  /// tau += friction at dq; n values each. One thread at a time.
  void add(const double* dq, double* tau) noexcept;

 private:
  std::function<void(const double*, double*)> friction_;
  Eigen::VectorXd band_, lower_, upper_;  ///< friction at dq = -band and band
  Eigen::VectorXd at_velocity_;
};

}  // namespace dyngen::runtime
