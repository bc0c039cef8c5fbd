// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>

#include "runtime/effects/effect_recordings.h"

namespace dyngen::runtime {

/// What recordings do not say of the model's torque on others: for each joint the variance of the
/// predicted torque, from the covariance of the parameters that were fitted to the first, over that
/// of the residual. (n) mean over all equations; p/N where both move alike, above 1 a prediction is
/// worth less than none.
Eigen::VectorXd predicted_variance(const EffectRecordings& train, const EffectRecordings& heldout);

/// Why recordings cannot carry a test: too few equations for the parameters of a joint, or
/// parameters so open that the held-out motion is not predicted; empty: they can.
/// @param with_regressor  whether the parameters are fitted at all
std::string why_insufficient(const EffectRecordings& train, const EffectRecordings& heldout,
                             bool with_regressor);

}  // namespace dyngen::runtime
