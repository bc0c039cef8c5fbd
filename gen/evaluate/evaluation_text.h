// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/evaluate/robot_numbers.h"
#include "gen/evaluate/state_words.h"
#include "gen/robot_file/robot_file.h"

namespace dyngen {

/// The torque of the robot at a state and its parts, the poses of its links' frames, and its mass
/// matrix, as tables of at most 80 columns. What exceeds a limit of the file is said.
/// @param file  where the limits stand: of position, velocity, acceleration and torque
std::string evaluation_text(RobotNumbers& robot, const RobotFile& file, const StateRequest& state);

}  // namespace dyngen
