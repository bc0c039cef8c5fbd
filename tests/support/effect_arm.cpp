// SPDX-License-Identifier: MIT
#include "tests/support/effect_arm.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <utility>

namespace dyngen::test {

const char* const kAlgebraicRows =
    "effect stribeck joint=2 Fs=3.1 vs=0.05\n"
    "effect load_friction joint=1 mu=*\n"
    "effect cogging joint=2 a=0.3 b=0.2 n=24\n"
    "effect power_law_viscous joint=1 Fa=0.8 alpha=0.7\n"
    "effect gas_spring joint=2 F0=500 n=1.3\n"
    "effect gear_efficiency joint=2 eta_drive=0.9 eta_back=0.8\n"
    "effect motor_coupling joint=2 other=1 F=0.3 Fvm=0.1 I=0.02 ratio=0.5";
const char* const kStatefulRows =
    "effect dahl joint=1 F=0.7 zs=0.003\n"
    "effect lugre joint=2 F=1.5 rise=1.3 vs=0.1 zs=0.002\n"
    "effect maxwell_slip joint=2 F1=0.1 F2=0.2 F3=0.3 F4=0.4 zs=0.0005\n"
    "effect elasto_plastic joint=1 F=0.5 zs=0.002 begin=0.4\n"
    "effect thermal_power joint=2 kv=-0.01 kc=0.002 warm=3\n"
    "effect exponential_viscous joint=1 A=0.4 vt=0.5";

RobotModel arm_with(const std::string& rows) {
  std::ifstream file(std::string(DYNGEN_SOURCE_DIR "/robots/planar2r.robot"));
  std::stringstream text;
  text << file.rdbuf();
  std::string robot = text.str();
  return parse_model(robot.replace(robot.rfind("stop"), 4, rows + "\nstop"));
}

std::vector<MotionSample> arm_motion(int count) {
  std::vector<MotionSample> samples;
  for (int k = 0; k < count; ++k) {
    const double t = k * kArmPeriod;
    MotionSample sample;
    for (const double w : {23.0, 31.0}) {
      sample.q.push_back(0.4 + 0.05 * std::sin(w * t));
      sample.dq.push_back(0.05 * w * std::cos(w * t));
      sample.ddq.push_back(-0.05 * w * w * std::sin(w * t));
    }
    if (k == 70) sample.dq = {0.0, 0.0};
    samples.push_back(std::move(sample));
  }
  return samples;
}

GeneratorOptions functions_of(std::vector<std::string> names) {
  GeneratorOptions options;
  options.functions = std::move(names);
  return options;
}

std::vector<double> evaluated_call(const EvaluatedModel& model, const std::string& function,
                                   const MotionSample& sample, EffectState& state) {
  return model.code().memory.empty() ? model.call(function, sample)
                                     : model.advance(function, sample, state);
}

}  // namespace dyngen::test
