// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/second_scan.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace dyngen::runtime {
namespace {

bool is_scanned(const Hypothesis& hypothesis) {
  if (hypothesis.windowed) return false;
  return std::any_of(hypothesis.shapes.begin(), hypothesis.shapes.end(), [&](int p) {
    return hypothesis.effect.law.parameters[static_cast<std::size_t>(p)].role ==
           EffectRole::kScanned;
  });
}

}  // namespace

bool scan_again(const CompetitionData& data, const Sought& sought, EvidenceSystem::Options options,
                CompetitionResult& result) {
  options.surrogates = 0;
  bool moved = false;
  for (std::size_t i = 0; i < result.winners.size(); ++i) {
    const Hypothesis& hypothesis = sought.hypotheses[result.winners[i].hypothesis];
    if (!is_scanned(hypothesis)) continue;
    const EvidenceSystem system =
        system_without(data.evidence, data.signals, sought.hypotheses, result, i, options);
    const EffectScales here = sought.scales.of(result.fit.point.beta, hypothesis.effect);
    std::vector<EffectInstance> trials = {result.fit.point.effects[i]};
    for (const int p : hypothesis.linear) {
      trials.front().parameters[p] = hypothesis.effect.parameters[p];
    }
    if (!hypothesis.ordered) {
      for (const Eigen::VectorXd& shapes : shape_grid(hypothesis, here, 1)) {
        trials.push_back(with_shapes(hypothesis, shapes));
      }
    }
    std::optional<TrialScore> best;
    for (const TrialScore& trial :
         try_shapes(data.evidence, data.signals, system, hypothesis, trials, here, false)) {
      if (trial.admissible && (!best || trial.priced() > best->priced())) best = trial;
    }
    if (!best) continue;
    best = refined(data.evidence, data.signals, system, hypothesis, *best, here);
    result.fit.point.effects[i] = best->effect;
    result.winners[i].trial = std::move(*best);
    moved = true;
  }
  return moved;
}

}  // namespace dyngen::runtime
