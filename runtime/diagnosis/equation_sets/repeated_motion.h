// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/effects/effect_recordings.h"
#include "runtime/identification/motion_source.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// The same torque at the motion of the other periods: where the motion of a run repeats, position,
/// velocity and acceleration are the mean of the samples of the same phase in all periods but their
/// own. Noise of the positions is then not that of the torque, which a controller makes of them. A
/// run that does not repeat, or not after a whole number of samples, stays as it is.
MotionSource with_repeated_motion(const MotionSource& source, const EquationRules& rules = {});

/// Whether a run of a recording repeats, so that its motion has others to be the mean of.
bool repeats(const MotionSource& source, const EquationRules& rules = {});

/// A recording with two motions of it whose noise is not the same: what is left is of the own one,
/// columns are of the other.
struct TwoMotions {
  MotionSource own, other;
};

/// Where the motion repeats, as it is recorded, and of the other periods; else of every other
/// sample each (OtherStates::parities); twice the same where neither can be.
TwoMotions two_motions(const MotionSource& source, const EquationRules& rules = {});

/// The same of several recordings: those of one motion, EquationRules::fewest_periods and more, are
/// periods of it.
std::vector<TwoMotions> two_motions(const std::vector<MotionSource>& sources,
                                    const EquationRules& rules = {});

/// The torque becomes what the model has at the other motion and what it leaves at the own one:
/// noise of the own motion is in what is left then, and not in the columns. A refit has the
/// estimate of instrumental variables, as which the other motion's regressor serves: found in
/// rounds, since what is left depends on it. Equations count that do at both.
/// @param repeated  equations at TwoMotions::other  @param own  at TwoMotions::own
/// @return          the model's parameters, (nb)
Eigen::VectorXd leave_as_at(EffectRecordings& repeated, const EffectRecordings& own);

/// The same with parameters that other equations of these recordings gave. @param beta  (nb)
void leave_as_at(EffectRecordings& repeated, const EffectRecordings& own,
                 const Eigen::VectorXd& beta);

}  // namespace dyngen::runtime
