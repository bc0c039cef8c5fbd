// SPDX-License-Identifier: MIT
#pragma once

#include <dart/dynamics/Skeleton.hpp>
#include <vector>

#include "tests/support/numeric_robot.h"

namespace dyngen::test {

/// A robot in DART, whose headers are slow to compile.
struct DartSkeleton {
  dart::dynamics::SkeletonPtr skeleton;
  std::vector<dart::dynamics::BodyNode*> bodies;  ///< of the links
};

DartSkeleton make_dart_skeleton(const NumericRobot& robot);

}  // namespace dyngen::test
