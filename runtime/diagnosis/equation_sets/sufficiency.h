// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>

#include "runtime/effects/effect_recordings.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// What recordings do not say of the model's torque on others: for each joint the variance of the
/// predicted torque, from the covariance of the parameters that were fitted to the first, over that
/// of the residual. (n) mean over all equations; p/N where both move alike, above 1 a prediction is
/// worth less than none.
Eigen::VectorXd predicted_variance(const EffectRecordings& train, const EffectRecordings& heldout);

/// Why recordings cannot carry a test: too few equations for the parameters of a joint; empty: they
/// can.
std::string why_too_few(const EffectRecordings& train, const EquationRules& rules = {});

/// Why recordings in which nothing was found cannot be called clean: what they leave open of the
/// parameters moves the held-out torque too much; empty: they can.
std::string why_too_little_motion(const EffectRecordings& train, const EffectRecordings& heldout,
                                  const EquationRules& rules = {});

}  // namespace dyngen::runtime
