// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/diagnosis.h"
#include "runtime/evidence/evidence_system.h"
#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::test {

/// The planar arm of effect_arm.h as a diagnosis reads it: white noise, one equation a sample.
inline constexpr double kArmNoise = 0.1;  // N m

runtime::TorqueNoiseModel arm_noise();
runtime::EffectRecordings arm_recordings(const std::vector<runtime::MotionSource>& sources);
/// What the model with the true parameters leaves, whitened.
runtime::EvidenceSystem arm_system(const runtime::EffectRecordings& data);

/// Two recordings of 30 s, of different motions.
std::vector<runtime::MotionSource> two_recordings(
    const std::vector<runtime::EffectInstance>& effects, unsigned seed);

/// Every law on each joint, nothing of it known; a family of its own each.
std::vector<runtime::EffectInstance> on_both_joints(const std::vector<runtime::EffectLaw>& laws);

/// @param effects  that are in the held-out recording, of 20 s
runtime::DiagnosisInput arm_input(std::vector<runtime::MotionSource> train,
                                  const std::vector<runtime::EffectInstance>& effects,
                                  const std::vector<runtime::EffectLaw>& laws);

runtime::DiagnosisOptions every_sample();

}  // namespace dyngen::test
