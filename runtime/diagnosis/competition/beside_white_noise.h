// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/diagnosis/competition/competition_result.h"

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

}  // namespace dyngen::runtime
