// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <utility>
#include <vector>

#include "gen/base_parameters/column.h"
#include "gen/symbols/symbolic_robot.h"

namespace dyngen {

/// column = sum of coefficient * other, on every motion; without others the column is zero.
struct Dependency {
  Column column;
  std::vector<std::pair<Column, GiNaC::ex>> others;
};

/// Which motions the columns are compared on.
enum class Motions {
  kAll,      ///< inverse dynamics
  kStanding  ///< gravity only
};

/// What find_dependencies() has found.
struct Dependencies {
  std::vector<Dependency> found;
  /// Columns that depend on others by coefficients that are no simple function of the unknown
  /// lengths: their parameters stay apart, and the set is larger than it need be.
  std::vector<Column> unsolved;
};

/// Finds the columns that depend on columns before them, scanning from left to right
/// (thesis 3.3.2).
///
/// Ranks are decided in extended precision on random motions; each dependency is then solved again
/// with 60 digits and kept only if it holds to 42 on motions that were not used to find it. Where
/// lengths are unknown, its coefficients are found as functions of them, see interpolate().
///
/// @param columns  in the order of preference: what comes first stays
Dependencies find_dependencies(const SymbolicRobot& robot, const std::vector<Column>& columns,
                               Motions motions);

}  // namespace dyngen
