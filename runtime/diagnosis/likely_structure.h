// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "runtime/diagnosis/competition_result.h"

namespace dyngen::runtime {

/// A model, and everything beside it.
struct ModelSide {
  const EvidenceSystem& system;
  const Screening& screening;
};

/// All that was found beside white noise of the deviations of what the fit leaves.
EvidenceSystem beside_white_noise(const EffectRecordings& data, EffectSignals& signals,
                                  const std::vector<Hypothesis>& hypotheses,
                                  const CompetitionResult& result, EvidenceSystem::Options options);

/// What a system beside white noise leaves of the equations, run by run.
/// @param deviation  (n) N m or N, of that noise
RunResiduals rests_of(const EffectRecordings& data, const EvidenceSystem& white,
                      const Eigen::VectorXd& deviation);

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
