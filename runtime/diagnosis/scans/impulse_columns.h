// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/effects/effect_recordings.h"
#include "runtime/evidence/joint_columns.h"

namespace dyngen::runtime {

/// Stiction impulses: torque columns of one instant each, where a joint reverses or stops. They are
/// short compared with the filter of the equations and represent any friction at that instant. A
/// longer standstill has none, since none of its equations counts.
/// @return one column for each of them, 0 outside of its recording
JointColumns impulse_columns(const EffectRecordings& data, int joint);

}  // namespace dyngen::runtime
