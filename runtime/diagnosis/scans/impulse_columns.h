// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/effects/effect_recordings.h"
#include "runtime/evidence/joint_columns.h"

namespace dyngen::runtime {

/// Impulses of torque where a joint turns or stops, short beside the filter of the equations:
/// what friction may do there, whatever it is. Where it stands for long there are none: no equation
/// of that time counts.
/// @return one column for each of them, 0 outside of its recording
JointColumns impulse_columns(const EffectRecordings& data, int joint);

}  // namespace dyngen::runtime
