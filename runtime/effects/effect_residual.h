// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/effects/effect_rows.h"

namespace dyngen::runtime {

/// rms of tau less Y x over the equations that count. @param x  (columns of Y)   @return (n)
Eigen::VectorXd residual_rms(const std::vector<RowBlock>& blocks, const Eigen::VectorXd& x);

/// rms of tau less the model with its effects, (n) each; states begin as first_states() says
/// unless the point has states for as many runs.
Eigen::VectorXd residual_with_effects(const EffectRecordings& data, const EffectPoint& point);

/// The equations that are left for the model: tau less the effects, and Y. For what looks at beta
/// alone.
std::vector<RowBlock> without_effects(const EffectRecordings& data, const EffectPoint& point);

}  // namespace dyngen::runtime
