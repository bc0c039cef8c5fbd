// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/effects/effect_recordings.h"
#include "runtime/identification/motion_source.h"

namespace dyngen::runtime {

/// The same torque at the motion of the other periods: where the motion of a run repeats, position,
/// velocity and acceleration are the mean of the samples of the same phase in all periods but their
/// own. Noise of the positions is then not that of the torque, which a controller makes of them. A
/// run that does not repeat, or not after a whole number of samples, stays as it is.
MotionSource with_repeated_motion(const MotionSource& source);

/// What the model leaves at the own motion becomes what it leaves at the repeated one: noise of the
/// motion would be in both the columns and what they are held against, as it is at the own motion,
/// only less.
/// @param repeated  equations at the mean motion of the other periods  @param own  the same as they
///                  are recorded
void leave_as_at(EffectRecordings& repeated, const EffectRecordings& own);

}  // namespace dyngen::runtime
