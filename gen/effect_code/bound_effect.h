// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "gen/effect_file/effect_file.h"
#include "gen/effects/effect_catalogue.h"
#include "gen/model/robot_model.h"

namespace dyngen {

/// A row `effect` of a robot file with the file that says what it means.
struct BoundEffect {
  std::shared_ptr<const EffectFile> file;
  int joint = 0;  ///< from 1; 0 of scope robot
  int other = 0;  ///< of scope pair
  /// Of each parameter of the file; unknown where the row has '*' or leaves out what has no number
  /// as its start.
  std::vector<Quantity> parameters;
  SourcePosition position;  ///< of the row's name
};

/// The robot's effects, checked: known names, joints that move, parameters within their bounds.
/// @throws ModelError  positioned in the robot file, up to 20 messages
std::vector<BoundEffect> bind_effects(const RobotModel& model, const EffectCatalogue& catalogue);

/// The same checks on a file as it is read, whose other rows may be wrong.
void check_effect_rows(const RobotFile& file, const EffectCatalogue& catalogue,
                       Diagnostics& diagnostics);

/// Warns of rows whose numbers contradict a requirement of their effect's file, with the friction
/// and rotor inertia that the robot file gives their joint.
void check_requirements(const std::vector<BoundEffect>& effects, const RobotModel& model,
                        Diagnostics& diagnostics);

}  // namespace dyngen
