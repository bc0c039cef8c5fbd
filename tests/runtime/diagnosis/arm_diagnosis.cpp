// SPDX-License-Identifier: MIT
#include "tests/runtime/diagnosis/arm_diagnosis.h"

#include <utility>

#include "runtime/effects/absorption.h"

namespace dyngen::test {

using Eigen::VectorXd;
using runtime::EffectInstance;
using runtime::EffectLaw;
using runtime::MotionSource;

runtime::TorqueNoiseModel arm_noise() {
  return {runtime::quick_noise(runtime::white_noise(VectorXd::Constant(2, kArmNoise)).joints),
          VectorXd::Constant(2, 2000), false, VectorXd::Ones(2)};
}

runtime::EffectRecordings arm_recordings(const std::vector<MotionSource>& sources) {
  return effect_recordings(planar_arm(), planar_arm_tangents(), sources, {1, -1}, {true, true});
}

runtime::EvidenceSystem arm_system(const runtime::EffectRecordings& data) {
  runtime::RunResiduals residuals;
  for (const runtime::EffectRun& run : data.runs) {
    residuals.push_back(residual(run.rows, planar_arm_values()));
  }
  return {data, residuals, arm_noise(), {}};
}

std::vector<MotionSource> two_recordings(const std::vector<EffectInstance>& effects,
                                         unsigned seed) {
  return measured({sines(30, 0.01, 0.3), sines(30, 0.01, 2.3)}, planar_arm_values(), effects,
                  kArmNoise, 0, seed);
}

std::vector<EffectInstance> on_both_joints(const std::vector<EffectLaw>& laws) {
  std::vector<EffectInstance> hypotheses;
  for (const EffectLaw& law : laws) {
    for (const int joint : {0, 1}) {
      EffectInstance effect = unknown(law, joint);
      effect.law.family = law.name;
      effect.link = joint + 1;
      hypotheses.push_back(std::move(effect));
    }
  }
  return hypotheses;
}

runtime::DiagnosisInput arm_input(std::vector<MotionSource> train,
                                  const std::vector<EffectInstance>& effects,
                                  const std::vector<EffectLaw>& laws) {
  runtime::DiagnosisInput input;
  input.model = planar_arm();
  input.robot = planar_arm_tangents();
  input.train = std::move(train);
  input.heldout =
      measured({sines(20, 0.01, 4.3, 0.9)}, planar_arm_values(), effects, kArmNoise, 0, 100);
  input.hypotheses = on_both_joints(laws);
  return input;
}

runtime::DiagnosisOptions every_sample() {
  runtime::DiagnosisOptions options;
  options.decimation = 1;
  return options;
}

}  // namespace dyngen::test
