// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/names/findings.h"
#include "runtime/evidence/evidence_system.h"

namespace dyngen::runtime {

/// The tests that an effect's file asks of its name (EffectLaw::tests), as far as recordings can
/// answer them. Most say that one size holds under two conditions: at low and at high speed, in
/// both directions, for small and large loads, early and late. The effect's torque, whitened and
/// without what the model absorbs, is fitted to what is left on each side by itself; a name passes
/// if both sizes agree within 3.5 standard deviations. Where one side holds too little of the
/// effect, or a test asks for another recording, the outcome is not known and says what is needed.
/// @param system  of the model without the effect, as location_of() has it
/// @param effect  at its estimate
std::vector<FalsifierOutcome> name_tests(const EffectRecordings& data, EffectSignals& signals,
                                         const EvidenceSystem& system,
                                         const EffectInstance& effect);

}  // namespace dyngen::runtime
