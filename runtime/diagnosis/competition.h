// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "runtime/diagnosis/screening.h"
#include "runtime/effects/effect_fit.h"

namespace dyngen::runtime {

/// An effect that won a round.
struct Winner {
  std::size_t hypothesis = 0;  ///< its place
  TrialScore trial;            ///< beside the model of its round
  double surprise = 0;         ///< in its round
  double heldout_before = 0;   ///< whitened squares of held-out residuals of its joints
  double heldout_after = 0;
  std::vector<NamedResult> others;  ///< its round's results, its own among them
};

/// Structure that no effect explains.
struct Nameless {
  GenericStructure structure;
  Score score;
  double surprise = 0;
  double rms = 0;  ///< N m or N, of what the columns explain of the joint's equations
};

/// How a competition ended.
struct CompetitionResult {
  std::vector<Winner> winners;
  std::vector<Nameless> nameless;
  EffectFit base;          ///< of the model alone
  EffectFit fit;           ///< of the model with the winners
  TorqueNoiseModel noise;  ///< of the last round
  Screening first, last;   ///< of the model alone, and with everything that was found
};

struct CompetitionOptions {
  double false_alarm = 0.01;
  int most_winners = 4;
  std::uint64_t seed = 1;
  bool with_regressor = true;
};

using CompetitionProgress = std::function<void(const std::string& stage, double done)>;

/// Round by round: everything is tested beside the model with what was found before; the best
/// effect is fitted together with all of it and stays if noise alone would hardly have given it and
/// it helps on held-out recordings. At the end each winner is tested again beside all others.
CompetitionResult compete(const EffectRecordings& train, const EffectRecordings& heldout,
                          const std::vector<Hypothesis>& hypotheses,
                          const CompetitionOptions& options,
                          const CompetitionProgress& progress = {});

/// The model with what is given beside it: regressor, effects at their estimates with the columns
/// of all their unknown parameters, and columns of structures.
EvidenceSystem system_at(const EffectRecordings& data, EffectSignals& signals,
                         const EffectPoint& point, const std::vector<Hypothesis>& beside,
                         const TorqueNoiseModel& noise, const EvidenceSystem::Options& options);

/// What a score costs in the currency of squares: its parameters, at the information that the
/// equations hold (Schwarz 1978 with the number of independent samples).
double price_of(const Hypothesis& hypothesis, int degrees, const TorqueNoiseModel& noise);

}  // namespace dyngen::runtime
