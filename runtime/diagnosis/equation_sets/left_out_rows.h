// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/effects/effect_recordings.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// Takes out the equations of joints at standstill: stiction takes any value up to its breakaway
/// level there, which no law of sliding friction describes. Standstill is a time of at least a
/// tenth of a second below the speed. A reversal is shorter, and stays in.
/// @param run          its rows change
/// @param still_speed  (n) rad/s or m/s
void leave_out_standstill(EffectRun& run, const Eigen::VectorXd& still_speed,
                          const EquationRules& rules = {});

/// Takes out the equations near the stiction intervals of joints, where they reverse or stop, as
/// far as the filters reach.
/// @param run          its rows change
/// @param still_speed  (n) rad/s or m/s
/// @param joints       from 0
void leave_out_stiction(EffectRun& run, const Eigen::VectorXd& still_speed,
                        const std::vector<int>& joints);

/// Takes out all equations of joints, which are masked from then on.
/// @param joints  from 0
void leave_out_joints(EffectRecordings& data, const std::vector<int>& joints);

/// Adds the stiction intervals of joints to the unknown samples of a run; its equations stay.
/// @param run          its `unknown` grows
/// @param motion       in which the joints stick, of the same samples
/// @param still_speed  (n) rad/s or m/s
/// @param joints       from 0
/// @param around       s, before and after: how far the joint state's filter widens the interval
void mark_stiction(EffectRun& run, const Motion& motion, const Eigen::VectorXd& still_speed,
                   const std::vector<int>& joints, double around);

/// Takes out of held-out recordings the equations of joints outside of the positions of the fitted
/// recordings: the extrapolation of a polynomial there is no proof for or against it. A joint that
/// would have fewer than EquationRules::least_equations keeps all of its equations.
void leave_out_unvisited(EffectRecordings& heldout, const EffectRecordings& train,
                         const EquationRules& rules = {});

}  // namespace dyngen::runtime
