// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "runtime/effects/effect_recordings.h"
#include "runtime/rules/decision_rules.h"
#include "runtime/signals/motion.h"

namespace dyngen::runtime {

/// Of every motion an earlier one that is the same, by its positions; nothing where it repeats in
/// itself, or is of its own. Two are compared if their samples are EquationRules::period_mismatch
/// or less apart at the end.
std::vector<std::optional<EarlierRun>> earlier_motions(const std::vector<const Motion*>& motions,
                                                       const EquationRules& rules = {});

/// Sets EffectRun::earlier of all runs.
void find_same_motions(EffectRecordings& data, const EquationRules& rules = {});

/// Position, velocity and acceleration of every motion as the mean of the others that are the same;
/// nothing where fewer than EquationRules::fewest_periods are. Samples that no other one reaches
/// stay.
std::vector<std::optional<Motion>> of_same_motions(const std::vector<const Motion*>& motions,
                                                   const EquationRules& rules = {});

}  // namespace dyngen::runtime
