// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/generator/generator.h"
#include "gen/model/robot_model.h"
#include "tests/support/model_bridge.h"

/// A planar arm of two joints with effects, and a motion for it.
namespace dyngen::test {

inline constexpr int kArmSamples = 200;
inline constexpr double kArmPeriod = 0.002;  // s

/// Effects without memory, of both joints.
extern const char* const kAlgebraicRows;
/// Effects with 8 states in all.
extern const char* const kStatefulRows;

/// robots/planar2r.robot with rows `effect`.
RobotModel arm_with(const std::string& rows);

/// A motion that reverses, stands still and goes on, with its own derivatives.
std::vector<MotionSample> arm_motion(int count = kArmSamples);

GeneratorOptions functions_of(std::vector<std::string> names);

/// A function whether it takes a state or not.
std::vector<double> evaluated_call(const EvaluatedModel& model, const std::string& function,
                                   const MotionSample& sample, EffectState& state);

}  // namespace dyngen::test
