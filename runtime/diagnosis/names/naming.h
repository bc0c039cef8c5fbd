// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "runtime/diagnosis/competition/competition.h"
#include "runtime/diagnosis/competition/effort.h"
#include "runtime/diagnosis/names/rivals.h"

namespace dyngen::runtime {

/// Which names a finding may have.
struct Naming {
  std::vector<std::string> families;  ///< that these data cannot tell apart; the winner's first
  std::vector<Rival> rivals;          ///< the best of each other family, nearest first
  std::optional<Rival> kin;           ///< the best other one of the winner's family, on its joint
  std::vector<std::string> forms;     ///< RivalsOfWinner::forms
  std::vector<Rival> elsewhere;       ///< of the same family, on joints that are not told apart
  std::string unnamed;                ///< what has no name and comes nearest (UnnamedRival)
  Nameless unnamed_form;              ///< the same
  double unnamed_distance = std::numeric_limits<double>::infinity();  ///< by which it is worse
  double probability = 0;  ///< of the winner's family, 0 .. 1
  double lambda = 0;       ///< chi-square reduction of the winner beside all else, less its degrees
  double delta_bic = 0;
  double part_left = 0;  ///< of the winner's chi-square, after the refit of the model
  double selected = 0;   ///< share of the halves of the recordings in which it explains most

  /// The share of halves in which the winner or one of the families beside it explains most.
  [[nodiscard]] double stability() const;
};

/// Families and probability are those of the distances: to be called again once those change.
void conclude(Naming& naming);

/// @param winner  its place
Naming name_winner(const EffectRecordings& data, EffectSignals& signals,
                   const std::vector<Hypothesis>& hypotheses, const CompetitionResult& result,
                   std::size_t winner, const EvidenceSystem::Options& options);

/// What names are found with. All of it outlives it.
struct NamingData {
  const EffectRecordings& evidence;  ///< this and the next two: of CompetitionData
  const EffectRecordings& fit;
  const EffectRecordings& heldout;
  const std::vector<Hypothesis>& hypotheses;
  EvidenceSystem::Options options{};
  Effort effort;
};

/// Names of all winners. Another effect of the same family that explains more by now takes the
/// winner's place, unless held-out recordings say less for it. Where the nearest rival is no more
/// than kApart of chi-square worse, the model is fitted with it in the winner's place, and what
/// held-out recordings say of the two is added to their distance; a rival that is better then takes
/// the place. What has no name is a rival only if it predicts held-out recordings better than the
/// winner does. Once the effort is spent, names are compared without such fits.
/// @param signals  of the evidence   @param result  its winners and its fit, in place
std::vector<Naming> settle_names(const NamingData& data, EffectSignals& signals,
                                 CompetitionResult& result, const CompetitionProgress& progress);

}  // namespace dyngen::runtime
