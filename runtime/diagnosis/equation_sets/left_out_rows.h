// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/effects/effect_recordings.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// Takes out the equations of joints that stand: at rest friction holds any torque up to its own,
/// which no law of sliding friction describes. A joint stands where it stays below the speed for a
/// tenth of a second or more; passing through zero at a reversal is quicker, and stays in.
/// @param run          its rows change
/// @param still_speed  (n) rad/s or m/s
void leave_out_standstill(EffectRun& run, const Eigen::VectorXd& still_speed,
                          const EquationRules& rules = {});

/// Takes out the equations of joints where they turn or stop, as far as the filters reach from
/// there: for joints that friction holds there for an instant.
/// @param run          its rows change
/// @param still_speed  (n) rad/s or m/s
/// @param joints       from 0
void leave_out_stiction(EffectRun& run, const Eigen::VectorXd& still_speed,
                        const std::vector<int>& joints);

/// Adds to what is unknown of a run where joints turn or stop, and equations stay.
/// @param run          its `unknown` grows
/// @param motion       whose sticks they are, of the same samples
/// @param still_speed  (n) rad/s or m/s
/// @param joints       from 0
/// @param around       s, before and after: what the joint state's filter makes of a rest
void mark_stiction(EffectRun& run, const Motion& motion, const Eigen::VectorXd& still_speed,
                   const std::vector<int>& joints, double around);

/// Takes out of held-out recordings the equations of joints that are where no fitted recording was:
/// what a polynomial says there is no proof for or against it. A joint that is nearly always there
/// keeps its equations.
void leave_out_unvisited(EffectRecordings& heldout, const EffectRecordings& train,
                         const EquationRules& rules = {});

}  // namespace dyngen::runtime
