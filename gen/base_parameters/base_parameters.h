// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "gen/base_parameters/column.h"
#include "gen/base_parameters/dependencies.h"
#include "gen/symbols/symbolic_robot.h"

namespace dyngen {

/// A parameter of the program: a base parameter, or a standard one where nothing was grouped.
struct GroupedParameter {
  Column column;
  bool grouped = false;  ///< others were added to it: its name gets an R
  GiNaC::ex value;       ///< in the file's symbols, expanded

  [[nodiscard]] std::string name() const { return chi_name(column.kind, column.link, grouped); }
};

/// The robot with regrouped parameters: what cannot be told apart stands in one place, the rest is
/// 0.
struct Regrouping {
  SymbolicRobot robot;  ///< inertial parameters and IA replaced by the grouped ones
  std::vector<GroupedParameter> parameters;  ///< those that are not 0, in link order, chi order
  std::vector<Column> unsolved;  ///< might be grouped too: see Dependencies; empty as a rule
};

/// Regroups inertial parameters and rotor inertias to a minimal set.
///
/// First in closed form, from the tips to the base: what a revolute joint cannot show (YY with XX,
/// MZ, M) or a prismatic one (the inertia tensor) moves to the parent; a fixed link moves whole
/// (Gautier and Khalil, "Direct calculation of minimum set of inertial parameters of serial
/// robots", IEEE Trans. Robotics and Automation, 1990). Then find_dependencies() removes what the
/// geometry near the base leaves dependent.
///
/// @param motions  kStanding: minimal for gravity() alone
Regrouping regroup(const SymbolicRobot& robot, Motions motions = Motions::kAll);

/// The same list without any regrouping.
Regrouping keep_standard(const SymbolicRobot& robot);

}  // namespace dyngen
