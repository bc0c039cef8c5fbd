// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/competition/competition.h"
#include "runtime/diagnosis/names/findings.h"

namespace dyngen::runtime {

/// What changed on a robot between earlier recordings and those that are diagnosed: effects that no
/// recording by itself can tell from the model's parameters (a constant payload, an offset, a
/// spring, a gain) are columns of the later recordings alone, beside parameters that both share.
///
/// Their parameters are differences to the earlier state; they are part of the fitted model's own
/// parameters, and so no rows of effects.
/// @param result  of the competition on `train`
/// @throws std::invalid_argument  if the recordings do not fit together
std::vector<Finding> changes_since(const EffectRecordings& reference, const EffectRecordings& train,
                                   const std::vector<Hypothesis>& hypotheses,
                                   const CompetitionResult& result, double false_alarm);

}  // namespace dyngen::runtime
