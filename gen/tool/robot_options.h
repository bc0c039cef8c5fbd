// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/robot_input/robot_source.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace dyngen {

/// Adds a command's robot: its file, which is returned, and --base, --tip and --round-angles beside
/// it.
/// @param words  what the file is to the command
CLI::Option* add_robot(CLI::App& command, RobotSource& robot, const std::string& words);

/// Which part of a description the robot is: --base, --tip, --round-angles.
void add_robot_part(CLI::App& command, RobotSource& robot);

}  // namespace dyngen
