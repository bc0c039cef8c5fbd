// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/tools/dynid/options/options.h"
#include "runtime/tools/dynid/robot/identified_description.h"

namespace dyngen::runtime {

/// Whether a file is a robot's description and no robot file, by its name: .urdf, .xml, .mjcf.
bool is_description_name(const std::string& path);

/// The URDF or MJCF that -o writes other numbers into: that of --urdf or --mjcf, else the robot
/// itself. Empty: -o is a robot file, or nothing.
/// @throws std::invalid_argument  if the output's name, the description and the robot do not go
///         together
RobotSource write_back_target(const ToolOptions& options);

/// @throws std::invalid_argument  as write_back_target(), and for what goes with robot files alone
void check_write_back(const ToolOptions& options);

/// The description with the identified numbers, to be written.
/// @param identified  text of the robot file
/// @param comment     what is known of the numbers
/// @throws ModelError, NoBodiesError
WrittenBack made_description(const ToolOptions& options, const std::string& identified,
                             const std::vector<std::string>& comment,
                             const std::vector<MotionSource>& motions);

/// Writes it, and prints what was left out. @throws OutputError
void write_description(const WrittenBack& made);

}  // namespace dyngen::runtime
