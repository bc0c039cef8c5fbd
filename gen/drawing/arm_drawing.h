// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/model/robot_model.h"

namespace dyngen {

/// A drawing of an arm as an SVG file: links, joints about or along their z, all frames with the
/// numbers of their links, the ground, where weight pulls, a scale; in parallel projection with up
/// as gravity says it.
///
/// The configuration is that of make_posture() and stands in the picture, as do the numbers that
/// are drawn in place of run-time lengths. The same robot gives the same text.
std::string arm_drawing(const RobotModel& model);

}  // namespace dyngen
