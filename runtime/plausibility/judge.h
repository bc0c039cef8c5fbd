// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "runtime/identification/motion_source.h"
#include "runtime/model/linear_model.h"
#include "runtime/plausibility/remark.h"

namespace dyngen::runtime {

/// What is known of a robot before anything is fitted.
struct JudgedRobot {
  const LinearModel* model = nullptr;
  Eigen::VectorXd lowest, highest;  ///< (n) rad or m; infinite: not known; may be empty
  Eigen::VectorXd most_torque;      ///< (n) N m or N; infinite: not known; may be empty
  double reach = 0;                 ///< m, sum of the lengths of the table; 0: not known
  Eigen::Vector3d gravity =
      Eigen::Vector3d::Zero();  ///< m/s^2, acceleration of the base in frame 0
  /// The same robot with another gravity; may be empty.
  std::function<std::shared_ptr<const LinearModel>(const Eigen::Vector3d& gravity)> with_gravity{};
};

/// What recordings can hardly mean: units, signs, columns, times. Nothing is changed.
///
/// Signals are looked at by themselves (integers, two columns that are one, ranges, velocities
/// beside differences of positions). Then the model is fitted to some samples of all recordings;
/// where much torque is left, so are other readings of them (degrees, milliseconds, a sign that is
/// turned, two columns that are swapped), and a reading that leaves far less is named.
///
/// @param sources  as many joints as the robot; may be empty
/// @return  those that are refused first
std::vector<Remark> judge(const JudgedRobot& robot, const std::vector<MotionSource>& sources);

}  // namespace dyngen::runtime
