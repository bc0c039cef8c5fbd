// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/diagnosis/competition.h"

namespace dyngen::runtime {

/// Which names a finding may have.
struct Naming {
  std::vector<std::string> families;  ///< that these data cannot tell apart; the winner's first
  double probability = 0;             ///< of the winner's family, 0 .. 1
  double lambda = 0;                  ///< squares of the winner beside all else, less its degrees
  double delta_bic = 0;
  double part_left = 0;   ///< of the winner's squares, after the refit of the model
  std::string runner_up;  ///< the next effect of another family; empty: none
  double distance = 0;    ///< of the runner-up, in squares net of prices; inf: none
};

/// Winners are compared with all that was strong in their round, each beside the model with all
/// other winners. A family joins the set if its best effect is worse by fewer than kApart squares:
/// for two effects of noncentrality lambda and likeness c the difference has the mean
/// lambda (1 - c^2) and four times that for its variance.
inline constexpr double kApart = 9;

/// @param winner  its place
Naming name_winner(const EffectRecordings& data, EffectSignals& signals,
                   const std::vector<Hypothesis>& hypotheses, const CompetitionResult& result,
                   std::size_t winner, const EvidenceSystem::Options& options);

}  // namespace dyngen::runtime
