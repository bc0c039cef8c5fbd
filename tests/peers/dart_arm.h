// SPDX-License-Identifier: MIT
#pragma once

#include <dart/dynamics/Skeleton.hpp>
#include <vector>

#include "tests/support/numeric_robot.h"

namespace dyngen::test {

/// A robot as DART's skeleton: rigid bodies only, no rotor inertia and no friction.
struct DartArm {
  explicit DartArm(const NumericRobot& robot);

  dart::dynamics::SkeletonPtr skeleton;
  std::vector<dart::dynamics::BodyNode*> bodies;  ///< of the links, in the robot's order
};

}  // namespace dyngen::test
