// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>

#include "tests/support/central_inertia.h"
#include "tests/support/numeric_robot.h"

namespace dyngen::test {

/// Where a joint stands: parent's frame -> `before` -> motion about or along z -> `after` -> the
/// link's frame. Both conventions come to this form, which every peer can hold.
struct LinkFrames {
  Eigen::Isometry3d before, after;
};

inline LinkFrames link_frames(const NumericRobot& robot, std::size_t j) {
  using Eigen::AngleAxisd, Eigen::Isometry3d, Eigen::Translation3d, Eigen::Vector3d;
  const NumericJoint& joint = robot.joints[j];
  const Isometry3d x =
      AngleAxisd(joint.alpha, Vector3d::UnitX()) * Translation3d(Vector3d(joint.d, 0, 0));
  const Isometry3d z =
      AngleAxisd(joint.theta, Vector3d::UnitZ()) * Translation3d(Vector3d(0, 0, joint.r));
  if (robot.standard) return {Isometry3d::Identity(), z * x};
  return {x, z};
}

/// The moving joints' places in the robot's list.
inline std::vector<std::size_t> moving_joints(const NumericRobot& robot) {
  std::vector<std::size_t> result;
  for (std::size_t j = 0; j < robot.size(); ++j) {
    if (robot.joints[j].sigma != 2) result.push_back(j);
  }
  return result;
}

/// The link's inertia tensor about its centre of mass.
inline Eigen::Matrix3d central_tensor(const CentralInertia& link) {
  Eigen::Matrix3d tensor;
  tensor << link.xx, link.xy, link.xz, link.xy, link.yy, link.yz, link.xz, link.yz, link.zz;
  return tensor;
}

}  // namespace dyngen::test
