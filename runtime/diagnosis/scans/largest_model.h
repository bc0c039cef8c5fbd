// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/evidence/joint_columns.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// The largest plausible model beside the rigid one: for every joint smooth functions of its own
/// position, velocity and load, friction that depends on its position, its load and the distance
/// since its reversal, and the first two derivatives of its load by time, which lags and elasticity
/// leave. All of that depends on the state; what these columns leave depends on time alone: noise.
/// @return  for each joint that has equations its columns, behind the parallel filter; empty if the
/// equations of a
///          joint are too few for them (EquationRules::least_equations)
std::vector<JointColumns> largest_model(const EffectRecordings& data, EffectSignals& signals,
                                        const EquationRules& rules);

}  // namespace dyngen::runtime
