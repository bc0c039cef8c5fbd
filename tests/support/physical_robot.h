// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/numeric_robot.h"

namespace dyngen::test {

/// A random tree robot (every third seed: a chain) whose links could be built: each is a cloud of
/// point masses. Revolute, prismatic and fixed joints; the same seed gives the same robot.
NumericRobot physical_robot(unsigned seed, int joints);

}  // namespace dyngen::test
