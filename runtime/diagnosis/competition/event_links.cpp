// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/event_links.h"

#include <algorithm>
#include <utility>

namespace dyngen::runtime {

/// The model with a force on another link at the times of an event: what the event makes the
/// parameters of the model do to other joints is taken out.
EvidenceSystem EventLinks::beside_same_event(const EvidenceSystem& system, const Hypothesis& other,
                                             const Hypothesis& own,
                                             const EffectInstance& event) const {
  EffectInstance same = other.effect;
  for (std::size_t i = 0; i < other.shapes.size(); ++i) {
    same.parameters[other.shapes[i]] = event.parameters[own.shapes[i]];
  }
  same.recording = event.recording;
  EvidenceSystem beside = system;
  beside.add(hypothesis_columns(data_.evidence, data_.signals, system, other, same));
  return beside;
}

NamedResult EventLinks::on_nearest(NamedResult named, const EvidenceSystem& system,
                                   const Screening& screening,
                                   const std::set<std::size_t>& refused) const {
  for (;;) {
    const Hypothesis& own = sought_.hypotheses[named.hypothesis];
    const EffectInstance& event = named.best.effect;
    if (!own.windowed || !event.law.acts_inward || event.joint < 1) return named;
    const auto nearer =
        std::find_if(screening.named.begin(), screening.named.end(), [&](const NamedResult& other) {
          const EffectInstance& effect = sought_.hypotheses[other.hypothesis].effect;
          return effect.law.name == event.law.name && effect.joint == event.joint - 1;
        });
    if (nearer == screening.named.end() || refused.contains(nearer->hypothesis)) return named;
    if (!nearer->seen || !nearer->best.admissible || is_winner(result_, nearer->hypothesis) ||
        nearer->best.score.delta_chi2 < kLeastAsGood * named.best.score.delta_chi2 ||
        screening.family_wise(nearer->surprise) > false_alarm_ ||
        conditions_.is_no_event(system, *nearer)) {
      return named;
    }
    const Hypothesis& hypothesis = sought_.hypotheses[nearer->hypothesis];
    if (conditions_.carries_torque(beside_same_event(system, hypothesis, own, event), named,
                                   event.joint)) {
      return named;
    }
    NamedResult next = *nearer;
    next.best = refined(data_.evidence, data_.signals, system, hypothesis, next.best,
                        sought_.scales.of(result_.fit.point.beta, hypothesis.effect));
    next.surprise = surprise_of_refined(next, hypothesis);
    named = std::move(next);
  }
}

}  // namespace dyngen::runtime
