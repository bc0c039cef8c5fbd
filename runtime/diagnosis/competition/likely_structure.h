// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "runtime/diagnosis/competition/beside_white_noise.h"
#include "runtime/diagnosis/competition/competition_result.h"

namespace dyngen::runtime {

/// Structure without a name, with what is left beside it.
struct LikelyStructure {
  GenericResult generic;  ///< surprise: of the likelihoods' ratio
  double net = 0;         ///< the ratio less its price
  RunResiduals residuals;
};

/// Functions of the motion where no motion repeats. As for effects (LikelySearch), noise that has
/// most of a structure in it hides it: each joint's strongest beside white noise are compared by
/// their likelihoods. @return the one that pays most for itself; none that does not pay
/// @param plain  all that was found beside white noise; joints with nameless structure have theirs
std::optional<LikelyStructure> likeliest_structure(const EffectRecordings& data,
                                                   EffectSignals& signals,
                                                   const std::vector<GenericStructure>& structures,
                                                   const CompetitionResult& result,
                                                   const ModelSide& plain);

}  // namespace dyngen::runtime
