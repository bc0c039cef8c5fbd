// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <string>

#include "gen/symbols/symbolic_robot.h"

namespace dyngen {

/// A grouped parameter as a person writes it: what shares a factor of lengths stands in brackets,
/// "ZZ2 + IA2 + d3^2 (M3 + M4 + M5 + M6)".
/// @param value  linear in the parameters of the robot, polynomial in its lengths
std::string grouping_formula(const GiNaC::ex& value, const SymbolicRobot& robot);

}  // namespace dyngen
