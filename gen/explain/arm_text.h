// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/symbols/symbolic_robot.h"

namespace dyngen {

/// One entry per joint: type, parent, how its axis stands to the one before, distances, offset; and
/// gravity. In modified frames.
std::string describe_arm(const SymbolicRobot& robot);

}  // namespace dyngen
