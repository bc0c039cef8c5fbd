// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/robot_input/robot_source.h"

namespace CLI {
class App;
}

namespace dyngen {

/// Adds a command's robot: its file, and --base, --tip and --round-angles beside it.
/// @param words  what the file is to the command
void add_robot(CLI::App& command, RobotSource& robot, const std::string& words);

}  // namespace dyngen
