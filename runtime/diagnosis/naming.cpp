// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/naming.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

constexpr std::size_t kRivals = 24;    // effects that are compared with a winner
constexpr double kStrongEnough = 0.3;  // of the winner's squares in its round
/// Misfit of the noise model and of linearisation makes differences of squares wider than theory
/// has it: the odds are those of squares this much smaller.
constexpr double kCaution = 2;

/// Places of the strongest rivals of a winner in its round, itself first.
std::vector<std::size_t> rivals_of(const Winner& winner) {
  std::vector<std::size_t> places;
  for (const NamedResult& named : winner.others) {
    if (named.hypothesis == winner.hypothesis || !named.seen || !named.best.admissible) continue;
    if (named.best.score.squares < kStrongEnough * winner.trial.score.squares) continue;
    places.push_back(named.hypothesis);
  }
  std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
    return winner.others[a].best.score.squares > winner.others[b].best.score.squares;
  });
  if (places.size() > kRivals) places.resize(kRivals);
  places.insert(places.begin(), winner.hypothesis);
  return places;
}

}  // namespace

Naming name_winner(const EffectRecordings& data, EffectSignals& signals,
                   const std::vector<Hypothesis>& hypotheses, const CompetitionResult& result,
                   std::size_t winner, const EvidenceSystem::Options& options) {
  const EvidenceSystem system = system_without(data, signals, hypotheses, result, winner, options);
  const ScaleTable scales(data);
  const Winner& own = result.winners[winner];
  Naming naming;
  naming.distance = std::numeric_limits<double>::infinity();
  const std::string& family = hypotheses[own.hypothesis].effect.law.family;
  naming.families = {family};
  double best = 0;
  std::map<std::string, double> family_net;
  std::map<std::string, std::string> family_effect;
  for (const std::size_t rival : rivals_of(own)) {
    const Hypothesis& hypothesis = hypotheses[rival];
    const EffectScales here = scales.of(result.fit.point.beta, hypothesis.effect);
    TrialScore trial = rival == own.hypothesis ? own.trial : own.others[rival].best;
    try {
      EffectInstance start = trial.effect;
      for (const int p : hypothesis.linear) {
        start.parameters[p] = hypothesis.effect.parameters[p];
      }
      trial = refined(data, signals, system, hypothesis,
                      try_hypothesis(data, signals, system, hypothesis, start, here, false), here);
    } catch (const std::invalid_argument&) {
      continue;
    }
    const double net =
        trial.score.squares - price_of(hypothesis, trial.score.degrees, result.noise);
    if (rival == own.hypothesis) {
      best = net;
      naming.lambda = std::max(0.0, trial.score.squares - trial.score.degrees);
      naming.delta_bic = -net;
      naming.part_left = trial.score.part_left;
    } else if (!trial.admissible) {
      continue;
    }
    const auto [entry, added] = family_net.try_emplace(hypothesis.effect.law.family, net);
    if (added || net > entry->second) {
      entry->second = net;
      family_effect[hypothesis.effect.law.family] = short_name(hypothesis.effect);
    }
  }
  double rest = 0;
  std::vector<std::pair<double, std::string>> near;
  for (const auto& [other, net] : family_net) {
    if (other == family) continue;
    const double distance = best - net;
    rest += std::exp(-std::clamp(distance, -200.0, 200.0) / (2 * kCaution));
    if (distance < kApart) near.emplace_back(distance, other);
    if (distance < naming.distance) {
      naming.distance = distance;
      naming.runner_up = family_effect[other];
    }
  }
  std::sort(near.begin(), near.end());
  for (const auto& [distance, other] : near) naming.families.push_back(other);
  naming.probability = 1 / (1 + rest);
  return naming;
}

}  // namespace dyngen::runtime
