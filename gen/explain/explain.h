// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/model/robot_model.h"

namespace dyngen {

/// What was read of a robot, in words: its joints and how their axes stand to each other and in the
/// base's frame, at the configuration that the drawing shows (make_posture()); the base
/// parameters with the standard parameters that are grouped in each; what can be identified alone,
/// what only in sums, what not at all and why; the parameters that gravity alone shows.
///
/// Plain text of lines of at most 100 columns. The same robot gives the same text.
std::string explain(const RobotModel& model);

}  // namespace dyngen
