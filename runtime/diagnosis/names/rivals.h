// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "runtime/diagnosis/competition/competition_result.h"
#include "runtime/diagnosis/names/rival_families.h"

namespace dyngen::runtime {

/// Winners are compared with all that was strong in their round, each beside the model with all
/// other winners. For two effects of noncentrality lambda and likeness c the difference of squares
/// has the mean lambda (1 - c^2) and four times that for its variance. A family joins the set if
/// its best effect is worse by fewer than kApart squares, or if that mean is below kSeparable. What
/// has no name takes its part of the probability too.
inline constexpr double kApart = 9;
inline constexpr double kSeparable = 20;

/// A winner and all that was strong in its round, each at its best beside the model with all other
/// winners.
struct RivalsOfWinner {
  TrialScore own;             ///< the winner
  double net = 0;             ///< what it explains, less its price
  std::vector<Rival> others;  ///< of other families; their distance is what they explain, net
  std::optional<Rival> kin;   ///< the best other one of its family, on its joint
  /// Of its family, the nearest of each other joint, where these data do not tell it apart. Of two
  /// joints that are coupled the same two the other way round are no other ones.
  std::vector<Rival> elsewhere;
};

/// @param winner  its place
/// @param system  the model with all that was found but the winner
RivalsOfWinner rivals_of(const EffectRecordings& data, EffectSignals& signals,
                         const std::vector<Hypothesis>& hypotheses, const CompetitionResult& result,
                         std::size_t winner, const EvidenceSystem& system);

}  // namespace dyngen::runtime
