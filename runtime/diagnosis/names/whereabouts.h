// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/diagnosis/names/findings.h"
#include "runtime/diagnosis/scans/hypothesis.h"

namespace dyngen::runtime {

/// The variable in which the energy of an effect, less what the model absorbs, lies closest
/// together: the range that takes the smallest part of the samples for 70 % of it.
/// @param effect  at its estimate, beside the system
Whereabouts whereabouts_of(const EffectRecordings& data, EffectSignals& signals,
                           const EvidenceSystem& system, const Hypothesis& hypothesis,
                           const EffectInstance& effect);

}  // namespace dyngen::runtime
