// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// Gains of a controller of positions, one value a joint.
struct Gains {
  Eigen::VectorXd kp;  ///< N m/rad; of computed torque 1/s^2
  Eigen::VectorXd kd;  ///< N m s/rad; of computed torque 1/s

  /// @throws std::invalid_argument  if there are not `joints` values each, finite and not negative
  void validate(int joints) const;
};

/// kp = w^2, kd = 2 damping w with w = 2 pi bandwidth, for computed torque: every joint's error
/// then decays as that of a linear oscillator.
/// @param bandwidth  Hz, positive: the undamped natural frequency     @param damping  the ratio, >
/// 0
/// @throws std::invalid_argument
Gains acceleration_gains(int joints, double bandwidth, double damping);

/// The same times the inertia of each joint, for PD, gravity compensation and feedforward.
/// @param inertia  (n) kg m^2 or kg, positive: the diagonal of M at the posture where the robot
///                 works. Where M is larger the loop is slower and less damped.
Gains torque_gains(const Eigen::VectorXd& inertia, double bandwidth, double damping);

}  // namespace dyngen::runtime
