// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/equation_sets/diagnosis_input.h"
#include "runtime/diagnosis/equation_sets/division.h"
#include "runtime/diagnosis/names/findings.h"

namespace dyngen::runtime {

/// What is known of the quality of all recordings: those that are fitted first, then those that are
/// held out, then the reference.
/// @param parts  what of them is fitted
/// @param train  equations of that, which tell whether motion repeats; null: not known
std::vector<ConditionLine> condition_lines(const DiagnosisInput& input, const Division& parts,
                                           const EffectRecordings* train);

}  // namespace dyngen::runtime
