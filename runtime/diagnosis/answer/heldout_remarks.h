// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/diagnosis/names/findings.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// A sentence for each joint of which the findings predict held-out recordings worse than the model
/// alone does, by more than rounding and noise make of it.
std::vector<std::string> heldout_remarks(const HeldoutResidual& rms, const AnswerRules& rules = {});

}  // namespace dyngen::runtime
