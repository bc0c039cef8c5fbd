// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/rivals.h"

#include <algorithm>
#include <map>
#include <utility>

#include "runtime/diagnosis/names/imitation.h"

namespace dyngen::runtime {
namespace {

constexpr std::size_t kCompared = 24;  // effects that are compared with a winner
constexpr double kStrongEnough = 0.3;  // of the winner's chi-square reduction in its round

/// Places of the strongest rivals of a winner in its round. An event is none of what always acts:
/// held-out recordings, which do not have it, could not refuse it.
std::vector<std::size_t> strongest_of_round(const Winner& winner,
                                            const std::vector<Hypothesis>& hypotheses) {
  std::vector<std::size_t> places;
  for (const NamedResult& named : winner.others) {
    if (named.hypothesis == winner.hypothesis || !named.seen || !named.best.admissible) continue;
    if (hypotheses[named.hypothesis].windowed && !hypotheses[winner.hypothesis].windowed) continue;
    if (named.best.score.delta_chi2 < kStrongEnough * winner.trial.score.delta_chi2) continue;
    places.push_back(named.hypothesis);
  }
  std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
    return winner.others[a].best.score.delta_chi2 > winner.others[b].best.score.delta_chi2;
  });
  if (places.size() > kCompared) places.resize(kCompared);
  return places;
}

/// Whether two effects of one family act on the same joints, in whatever order.
bool on_the_same_joints(const EffectInstance& a, const EffectInstance& b) {
  return std::minmax(a.joint, a.other) == std::minmax(b.joint, b.other);
}

/// Whether a rival is a force on a link beyond the winner's. Such a force has the torques of the
/// winner's among its own: it imitates the winner on any data, by torques on the joints between
/// that happen to be 0. The penalty of its further parameters is what tells it from the winner.
bool is_beyond(const EffectInstance& rival, const EffectInstance& winner) {
  return rival.law.acts_inward && winner.law.acts_inward && rival.joint > winner.joint;
}

/// Of each joint the nearest, where these data do not tell it from the winner's.
/// @param elsewhere  distance is by what they are worse
std::vector<Rival> nearest_of_joints(std::vector<Rival> elsewhere,
                                     const std::vector<Hypothesis>& hypotheses,
                                     const EffectInstance& winner) {
  std::map<int, Rival> nearest;
  for (Rival& rival : elsewhere) {
    const EffectInstance& effect = hypotheses[rival.hypothesis].effect;
    const bool separable = rival.apart >= kSeparable || is_beyond(effect, winner);
    if (rival.distance >= kApart && separable) continue;
    const auto [entry, added] = nearest.try_emplace(effect.joint, rival);
    if (!added && rival.distance < entry->second.distance) entry->second = std::move(rival);
  }
  std::vector<Rival> all;
  for (auto& [joint, rival] : nearest) all.push_back(std::move(rival));
  return all;
}

/// The best shapes beside a system.
/// @param trial  where the search begins
TrialScore refined_beside(const EffectRecordings& data, EffectSignals& signals,
                          const EvidenceSystem& system, const Hypothesis& hypothesis,
                          const TrialScore& trial, const EffectScales& scales) {
  EffectInstance start = trial.effect;
  for (const int p : hypothesis.linear) start.parameters[p] = hypothesis.effect.parameters[p];
  return refined(data, signals, system, hypothesis,
                 try_hypothesis(data, signals, system, hypothesis, start, scales, false), scales);
}

}  // namespace

RivalsOfWinner rivals_of(const EffectRecordings& data, EffectSignals& signals,
                         const std::vector<Hypothesis>& hypotheses, const CompetitionResult& result,
                         std::size_t winner, const EvidenceSystem& system) {
  const ScaleTable scales(data);
  const Winner& own = result.winners[winner];
  const Hypothesis& winning = hypotheses[own.hypothesis];
  const auto at_its_best = [&](const Hypothesis& hypothesis, const TrialScore& trial) {
    return refined_beside(data, signals, system, hypothesis, trial,
                          scales.of(result.fit.point.beta, hypothesis.effect));
  };
  RivalsOfWinner rivals;
  rivals.own = at_its_best(winning, own.trial);
  rivals.net = net_of(winning, rivals.own, result.noise);
  for (const std::size_t place : strongest_of_round(own, hypotheses)) {
    const Hypothesis& hypothesis = hypotheses[place];
    TrialScore trial = at_its_best(hypothesis, own.others[place].best);
    if (!trial.admissible) continue;
    const double net = net_of(hypothesis, trial, result.noise);
    Rival rival{hypothesis.effect.law.family,
                short_name(hypothesis.effect),
                net,
                0,
                place,
                std::move(trial),
                0};
    if (rival.family != winning.effect.law.family) {
      rivals.others.push_back(std::move(rival));
      continue;
    }
    rival.distance = rivals.net - net;
    if (hypothesis.effect.joint == winning.effect.joint) {
      if (rival.distance < kApart) rivals.forms.push_back(hypothesis.effect.law.name);
      if (!rivals.kin || rival.distance < rivals.kin->distance) rivals.kin = std::move(rival);
    } else if (!on_the_same_joints(hypothesis.effect, winning.effect)) {
      rivals.elsewhere.push_back(std::move(rival));
    }
  }
  drop_what_adds_nothing(rivals.others, hypotheses, winning.effect.law.family, rivals.net);
  const JointColumns torque =
      system.whitened(effect_columns(data, signals, result.fit.point.effects[winner], {0}));
  for (auto* all : {&rivals.others, &rivals.elsewhere}) {
    for (Rival& rival : *all) {
      rival.apart = imitation(system, torque,
                              hypothesis_columns(data, signals, system,
                                                 hypotheses[rival.hypothesis], rival.trial.effect))
                        .left;
    }
  }
  rivals.elsewhere = nearest_of_joints(std::move(rivals.elsewhere), hypotheses, winning.effect);
  return rivals;
}

}  // namespace dyngen::runtime
