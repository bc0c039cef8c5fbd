// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runtime/diagnosis/competition/competition_data.h"
#include "runtime/diagnosis/competition/competition_result.h"

namespace dyngen::runtime {

struct CompetitionOptions {
  double false_alarm = 0;  ///< this and the next two: of DiagnosisOptions
  int most_winners = 0;
  double effort = 0;  ///< the same
  std::uint64_t seed = 0;
  bool with_regressor = true;
  DecisionRules rules;
  /// Whether it ends as soon as a joint is found to rest.
  bool until_stiction = false;
  /// Whether joints of this robot are known to rest: then another one does wherever impulses at its
  /// reversals are its strongest structure, and that is looked for first, as where nothing repeats.
  bool sticks = false;
};

using CompetitionProgress = std::function<void(const std::string& stage, double done)>;

/// Round by round: everything is tested beside the model with what was found before; the best
/// effect is fitted together with all of it and stays if noise alone would hardly have given it, it
/// is proved on held-out recordings and the half-band test does not contradict it. At the end each
/// winner is tested again beside all others.
CompetitionResult compete(const CompetitionData& data, const std::vector<Hypothesis>& hypotheses,
                          const CompetitionOptions& options,
                          const CompetitionProgress& progress = {});

}  // namespace dyngen::runtime
