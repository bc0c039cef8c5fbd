// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "runtime/model/linear_model.h"

namespace dyngen::runtime {

/// Where the tool's point is at q, (3) m in frame 0, and its derivatives by q, (3 x n).
struct ToolPoint {
  Eigen::Vector3d position;
  Eigen::Matrix3Xd jacobian;
};

/// A box along the axes of frame 0 that the tool's point must not enter.
struct KeepOutBox {
  Eigen::Vector3d lower, upper;  ///< m
  std::function<ToolPoint(const Eigen::VectorXd& q)> tool{};
};

/// What a motion may use. Infinite: no limit.
struct MotionLimits {
  Eigen::VectorXd lower, upper;  ///< (n) rad or m; finite
  Eigen::VectorXd speed;         ///< (n) rad/s or m/s
  Eigen::VectorXd acceleration;  ///< (n)
  Eigen::VectorXd torque;        ///< (n) N m or N
  /// (nb) parameters with which torque is foretold; empty: torque is not limited.
  Eigen::VectorXd beta;
  std::optional<KeepOutBox> box;

  /// @throws std::invalid_argument  naming what was found and what was expected
  void validate(const LinearModel& model) const;
  [[nodiscard]] bool limits_torque() const;
};

/// How much of its limits a motion uses: 1 is the limit. 0 where there is none.
struct LimitShares {
  Eigen::VectorXd position;      ///< (n) |q - middle| over half of the range
  Eigen::VectorXd speed;         ///< (n)
  Eigen::VectorXd acceleration;  ///< (n)
  Eigen::VectorXd torque;        ///< (n)
  /// m: of the tool's point outside the box; negative inside. Infinite without a box.
  double distance = 0;

  /// The largest share; above 1 if the tool's point is in the box.
  [[nodiscard]] double largest() const;
};

/// The shares over all instants of a motion.
LimitShares limit_shares(const LinearModel& model, const MotionLimits& limits,
                         const JointMotion& motion);

/// Constraints on a motion, each <= 0 where its limits are kept: position, speed and acceleration
/// of every joint, torque of all joints, the box.
///
/// Each stands for all instants: c = log(sum_k exp(s (share_k - 1))) / s, which is never below the
/// largest share less 1, so that what is kept here is kept at all these instants. (Kreisselmeier
/// and Steinhauser, 1979.)
struct MotionConstraints {
  Eigen::VectorXd values;              ///< (c)
  std::vector<JointMotion> by_motion;  ///< (c) gradients; empty matrices: zero
};

/// @param sharpness  s; the larger, the closer to the largest share
/// @param factor     of all limits: 0.9 leaves a tenth
MotionConstraints constraints_of(const LinearModel& model, const MotionLimits& limits,
                                 const JointMotion& motion, double sharpness, double factor = 1);

}  // namespace dyngen::runtime
