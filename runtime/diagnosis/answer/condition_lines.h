// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/names/findings.h"
#include "runtime/diagnosis/views/diagnosis_input.h"

namespace dyngen::runtime {

/// What is known of the quality of all recordings: those that are fitted first, then those that are
/// held out, then the reference.
/// @param train  equations of the first, which tell whether their motion repeats; null: not known
std::vector<ConditionLine> condition_lines(const DiagnosisInput& input,
                                           const EffectRecordings* train);

}  // namespace dyngen::runtime
