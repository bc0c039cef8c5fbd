// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/identification/motion_source.h"

namespace dyngen::runtime {

/// Which joints of a recording stand.
using StandingJoints = std::vector<bool>;

/// Joints that stand all through recordings: their largest speed there is less than kStandstillPart
/// of their own largest speed, or of that of the fastest joint of their kind, in the recordings
/// that are fitted. Such speeds are noise, or a drive that gives way.
/// @param fitted    recordings that tell how fast joints move
/// @param revolute  (n) joints that turn; others slide
/// @param looked_at recordings that are asked about
/// @return (recordings that are asked about x n); recordings of poses, in which no joint moves at
///         all, have none
std::vector<StandingJoints> standing_joints(const std::vector<MotionSource>& fitted,
                                            const std::vector<bool>& revolute,
                                            const std::vector<MotionSource>& looked_at);

/// The recording with its standing joints exactly still: at the mean position of each run, with
/// velocity and acceleration 0. Noise of their positions is no motion, and would show combinations
/// of parameters that their posture hides. They have no equations (RowOptions::still_speed).
/// A sentence in the condition names them.
/// @throws std::invalid_argument  if `standing` has not one value for each joint
MotionSource with_joints_still(const MotionSource& source, const StandingJoints& standing);

/// The same of all recordings. @param others  recordings that are not fitted; theirs change too
void hold_standing_joints(const std::vector<bool>& revolute, std::vector<MotionSource>& fitted,
                          const std::vector<std::vector<MotionSource>*>& others);

}  // namespace dyngen::runtime
