// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/diagnosis/equation_sets/stiction_joint.h"
#include "runtime/evidence/torque_noise_model.h"
#include "runtime/identification/motion_source.h"

namespace dyngen::runtime {

/// How the noise is known, and which samples of joints in stiction are not judged.
/// @param train     what StictionJoint::recordings counts
/// @param left_out  joints whose equations at their reversals do not count
/// @param impulses  joints that have an impulse at each reversal instead
/// @param disturbed joints, from 0, on which a disturbance inside the loop is seen
std::string noise_sentence(const TorqueNoiseModel& noise, const std::vector<MotionSource>& train,
                           const std::vector<StictionJoint>& left_out,
                           const std::vector<StictionJoint>& impulses,
                           const std::vector<int>& disturbed);

}  // namespace dyngen::runtime
