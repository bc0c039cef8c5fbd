// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/effects/effect_constraints.h"
#include "runtime/effects/effect_rows.h"

namespace dyngen::runtime {

/// Numbers for all parameters of effects: those they have, else the start of the effect's file.
/// @throws std::invalid_argument  if a given parameter has no number, or an effect's joint or pair
/// is not of the robot
std::vector<EffectInstance> with_starts(const ScaleTable& scales, const Eigen::VectorXd& beta,
                                        std::vector<EffectInstance> effects);

/// Values of the effect at `place` from which a search may start: each shape that has no number yet
/// is tried over a grid (kScanned as many values as its effect asks for, 4000 at most, others
/// `grid`) and then ever closer to the best value, what is linear being fitted to what the other
/// unknowns leave. Two that are scanned are tried together first. The best comes first.
/// @param as_written  the effect before with_starts(): NaN where a parameter has no number
/// @param refined     how many, where a parameter is scanned; one otherwise
std::vector<Eigen::VectorXd> start_values(const EffectRecordings& data, EffectSignals& signals,
                                          const ScaleTable& scales, const EffectPoint& point,
                                          std::size_t place, const EffectInstance& as_written,
                                          const Eigen::VectorXd& joint_weights, int grid,
                                          int refined);

}  // namespace dyngen::runtime
