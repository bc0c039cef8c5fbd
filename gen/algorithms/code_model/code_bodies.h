// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <string>
#include <vector>

#include "gen/model/robot_model.h"

namespace dyngen {

struct CodeModel;
struct SymbolicRobot;

/// The links as bodies, for functions whose result base parameters do not determine: centre of
/// mass and momentum.
struct CodeBodies {
  /// XX .. M of link j at j - 1, about the origin of its frame: exact numbers, symbols, or sums.
  std::vector<std::array<GiNaC::ex, kInertialCount>> links;
  /// Why the code does not know them; empty if it does.
  std::string why_absent = "the code knows no single bodies";
};

/// Gives a model its bodies, or the reason why it has none: the numbers of the file are base
/// parameters, the functions read base parameters, a body's parameter is unknown, a link has
/// first moments without mass, or the whole robot has no mass. A payload is part of the last link.
/// @param robot      before regrouping
/// @param regrouped  the links of the model hold base parameters
void add_bodies(CodeModel& code, const SymbolicRobot& robot, bool regrouped,
                ParameterMeaning meaning);

}  // namespace dyngen
