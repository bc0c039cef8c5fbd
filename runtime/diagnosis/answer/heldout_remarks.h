// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/diagnosis/names/findings.h"

namespace dyngen::runtime {

/// Held-out rms with the findings over that of the model alone, above which it is worse.
inline constexpr double kPredictedWorse = 1.02;
/// HeldoutResidual::visited: with less, the rest is where findings were not judged.
inline constexpr double kMostlyVisited = 0.98;

/// A sentence for each joint of which the findings predict held-out recordings worse than the model
/// alone does, by more than rounding and noise make of it.
std::vector<std::string> heldout_remarks(const HeldoutResidual& rms);

}  // namespace dyngen::runtime
