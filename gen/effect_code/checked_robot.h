// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gen/effect_code/bound_effect.h"
#include "gen/robot_file/body_checks.h"
#include "gen/robot_input/robot_source.h"

namespace dyngen {

/// A robot file with what its rows `effect` mean.
struct CheckedRobot {
  RobotFile file;
  /// Null: neither the file nor the call has effects.
  std::shared_ptr<const EffectCatalogue> catalogue;
};

/// Reads a robot in any form; what is wrong in rows `effect` is reported together with everything else.
/// @param folders  of effect files besides the program's own
/// @throws ModelError  positioned, up to 20 messages; also if a folder cannot be read
CheckedRobot read_checked_robot(const RobotSource& source, const std::vector<std::string>& folders);

/// Everything that is doubtful in the file. @param absent  what rows that are absent are
void add_robot_warnings(const CheckedRobot& robot, const RobotModel& model, AbsentRows absent,
                        Diagnostics& diagnostics);

}  // namespace dyngen
