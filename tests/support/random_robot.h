// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/numeric_robot.h"

namespace dyngen::test {

/// A robot for a RapidCheck property: 1 to 12 joints of all kinds, chains and trees, both DH
/// conventions, angles and zeros that matter to pruning.
NumericRobot random_robot();

}  // namespace dyngen::test
