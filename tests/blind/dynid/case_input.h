// SPDX-License-Identifier: MIT
// A case as dynid reads it: for what is held against dynid, and knows it.
#pragma once

#include <string>
#include <vector>

#include "runtime/diagnosis/equation_sets/diagnosis_input.h"

namespace blind {

/// Recordings as a diagnosis reads them: whole, every period by itself.
/// @throws RecordingError
std::vector<dyngen::runtime::MotionSource> read_recordings(const std::vector<std::string>& paths);

/// With every effect of the catalogue that can compete.
/// @throws ModelError, RecordingError
dyngen::runtime::DiagnosisInput case_input(const std::string& robot,
                                           const std::vector<std::string>& train,
                                           const std::vector<std::string>& heldout);

}  // namespace blind
