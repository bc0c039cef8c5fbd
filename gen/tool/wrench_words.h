// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/model/robot_model.h"

namespace dyngen {

/// The command line with "--wrench LINK" as one word, "--wrench=LINK". A word that begins with '-',
/// has '.' or '/' in it, or is the path of a file is no link: "--wrench arm.robot" is the option
/// without a link.
std::vector<std::string> with_joined_wrench(int argc, const char* const* argv);

/// The link that a word of --wrench means: its number, or the name of its joint; 0 for the last
/// one ("true", what the option is without a link).
/// @throws std::invalid_argument  if the robot has no such link
int wrench_link(const std::string& word, const RobotModel& model);

}  // namespace dyngen
