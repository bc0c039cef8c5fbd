// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/identification/motion_source.h"

namespace dyngen::runtime {

/// The same torque at the motion of the other periods: where the motion of a run repeats, position,
/// velocity and acceleration are the mean of the samples of the same phase in all periods but their
/// own. Noise of the positions is then not that of the torque, which a controller makes of them. A
/// run that does not repeat, or not after a whole number of samples, stays as it is.
MotionSource with_repeated_motion(const MotionSource& source);

}  // namespace dyngen::runtime
