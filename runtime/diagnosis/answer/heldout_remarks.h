// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/diagnosis/names/findings.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// A sentence for each joint of which the findings predict held-out recordings worse than the model
/// alone does, by more than rounding and noise make of it; and one for each joint whose held-out
/// torque is far above the noise near reversals alone.
/// @param judged  the same away from reversals
std::vector<std::string> heldout_remarks(const HeldoutResidual& rms, const HeldoutResidual& judged,
                                         const AnswerRules& rules = {});

}  // namespace dyngen::runtime
