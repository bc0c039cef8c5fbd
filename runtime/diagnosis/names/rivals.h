// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "runtime/diagnosis/competition/competition_result.h"
#include "runtime/diagnosis/names/rival_families.h"

namespace dyngen::runtime {

/// Winners are compared with all that was strong in their round, each beside the model with all
/// other winners. For two effects of noncentrality lambda and correlation c, the difference of
/// their chi-square reductions has the mean lambda (1 - c^2) and four times this as its variance. A
/// family joins the set if the reduction of its best effect is smaller by less than kApart, or if
/// that mean is below kSeparable. Structures without a name take their part of the probability too.
inline constexpr double kApart = 9;
inline constexpr double kSeparable = 20;

/// A winner and all that was strong in its round, each at its best beside the model with all other
/// winners.
struct RivalsOfWinner {
  TrialScore own;             ///< the winner
  double net = 0;             ///< its chi-square reduction, less its penalty
  std::vector<Rival> others;  ///< of other families; their distance is what they explain, net
  std::optional<Rival> kin;   ///< the best other one of its family, on its joint
  /// All others of its family on its joint that explain as much but for kApart: their names
  std::vector<std::string> forms;
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
