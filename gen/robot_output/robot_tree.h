// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/bodies/body_tree.h"
#include "gen/model/robot_model.h"
#include "gen/robot_file/robot_file.h"

namespace dyngen {

/// A robot file as bodies and joints: a body "base", and one for each row of the table, whose frame
/// stands on its joint's axis (z). Standard tables are brought to such frames. What a body tree
/// does not hold (off, amax, effects other than one linear spring a joint) is in the warnings, by
/// name.
///
/// @param target  "URDF" or "MJCF", for messages
/// @throws ModelError  positioned: unknown numbers ('*'), base parameters, first moments without
///         a mass
BodyTree robot_tree(const RobotFile& file, const RobotModel& model, const std::string& target);

/// A description, and what it has no field for.
struct WrittenRobot {
  std::string text;
  std::vector<Diagnostic> warnings;  ///< positioned in the robot file's source
};

/// The robot as URDF. Rotor inertia and gravity other than 9.81 m/s^2 are left out with a warning;
/// where gravity does not point along -z, a link "world" carries the base so that it does.
WrittenRobot urdf_text(const RobotFile& file, const RobotModel& model);

/// The robot as MJCF: rotor inertia becomes armature, a linear spring stiffness and springref.
WrittenRobot mjcf_text(const RobotFile& file, const RobotModel& model);

}  // namespace dyngen
