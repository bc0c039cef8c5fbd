// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/model/robot_model.h"

namespace dyngen {

/// The bodies whose ten numbers are known, in both forms: first moments and moments about the
/// frame's origin, centre of mass and moments about it. Empty if there is none, or the numbers are
/// base parameters.
std::string bodies_text(const RobotModel& model);

}  // namespace dyngen
