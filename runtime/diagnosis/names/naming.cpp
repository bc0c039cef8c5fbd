// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/naming.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "runtime/diagnosis/competition/heldout.h"
#include "runtime/diagnosis/competition/own_scatter.h"
#include "runtime/diagnosis/names/imitation.h"
#include "runtime/diagnosis/names/stability.h"
#include "runtime/diagnosis/names/unnamed_rival.h"

namespace dyngen::runtime {
namespace {

constexpr std::size_t kCompared = 24;  // effects that are compared with a winner
constexpr double kStrongEnough = 0.3;  // of the winner's squares in its round
/// Misfit of the noise model and of linearisation makes differences of squares wider than theory
/// has it: the odds are those of squares this much smaller.
constexpr double kCaution = 2;
constexpr double kEven = 0.5;  // squares that decide nothing

/// Places of the strongest rivals of a winner in its round, itself first. An event is none of what
/// always acts: held-out recordings, which do not have it, could not refuse it.
std::vector<std::size_t> rivals_of(const Winner& winner,
                                   const std::vector<Hypothesis>& hypotheses) {
  std::vector<std::size_t> places;
  for (const NamedResult& named : winner.others) {
    if (named.hypothesis == winner.hypothesis || !named.seen || !named.best.admissible) continue;
    if (hypotheses[named.hypothesis].windowed && !hypotheses[winner.hypothesis].windowed) continue;
    if (named.best.score.squares < kStrongEnough * winner.trial.score.squares) continue;
    places.push_back(named.hypothesis);
  }
  std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
    return winner.others[a].best.score.squares > winner.others[b].best.score.squares;
  });
  if (places.size() > kCompared) places.resize(kCompared);
  places.insert(places.begin(), winner.hypothesis);
  return places;
}

/// What held-out recordings say for a rival against a winner: squares of their residuals, where
/// these are more than noise in units of what they are.
double heldout_gain(const EffectRecordings& heldout, const TorqueNoiseModel& noise,
                    const EffectPoint& winner, const EffectPoint& rival) {
  const Eigen::VectorXd before = heldout_squares(heldout, winner, noise);
  const Eigen::VectorXd after = heldout_squares(heldout, rival, noise);
  double gain = 0;
  for (int j = 0; j < heldout.joints(); ++j) {
    double equations = 0;
    for (const EffectRun& run : heldout.runs) equations += run.rows.counted.col(j).sum();
    gain += (before[j] - after[j]) / std::max(1.0, before[j] / std::max(equations, 1.0));
  }
  return gain;
}

/// The model with a rival in the place of a winner; nothing if a bound, a falsifier or a parameter
/// that the data do not determine speaks against it.
std::optional<EffectFit> with_rival(const EffectRecordings& fitted, const CompetitionResult& result,
                                    std::size_t place, const Rival& rival) {
  std::vector<EffectInstance> effects = result.fit.point.effects;
  effects[place] = rival.trial.effect;
  try {
    EffectFit fit = fit_effects(fitted, effects);
    for (const EffectRemark& remark : fit.remarks) {
      if (fit.objects(remark, static_cast<int>(place))) return std::nullopt;
    }
    return fit;
  } catch (const std::invalid_argument&) {
    return std::nullopt;  // no finite torque at the shapes that were tried
  }
}

/// What is another family at some parameters has to explain more than that one: else its further
/// parameters are worth nothing.
/// @param rivals  distance is what they explain, net   @param family, net  the winner's
void drop_what_adds_nothing(std::vector<Rival>& rivals, const std::vector<Hypothesis>& hypotheses,
                            const std::string& family, double net) {
  std::map<std::string, double> explained = {{family, net}};
  for (const Rival& rival : rivals) {
    const auto entry = explained.try_emplace(rival.family, rival.distance).first;
    entry->second = std::max(entry->second, rival.distance);
  }
  std::erase_if(rivals, [&](const Rival& rival) {
    const std::vector<std::string>& parts = hypotheses[rival.hypothesis].effect.law.contains;
    return std::any_of(parts.begin(), parts.end(), [&](const std::string& part) {
      const auto entry = explained.find(part);
      return entry != explained.end() && entry->second >= rival.distance;
    });
  });
}

std::map<std::string, Rival> best_of_families(std::vector<Rival> rivals) {
  std::map<std::string, Rival> best;
  for (Rival& rival : rivals) {
    const auto [entry, added] = best.try_emplace(rival.family, rival);
    if (!added && rival.distance > entry->second.distance) entry->second = std::move(rival);
  }
  return best;
}

/// How often the winner and each rival explain most of a half of the recordings.
/// @param net     what the winner explains, net
/// @param rivals  by family; their distance is still what they explain, net
void select_from_halves(const EffectRecordings& data, EffectSignals& signals,
                        const EvidenceSystem& system, const std::vector<Hypothesis>& hypotheses,
                        const Winner& own, const TrialScore& found, double net, std::uint64_t seed,
                        Naming& naming, std::map<std::string, Rival>& rivals) {
  const auto contender = [&](std::size_t hypothesis, const TrialScore& trial, double left) {
    return Contender{
        hypothesis_columns(data, signals, system, hypotheses[hypothesis], trial.effect),
        trial.score.squares - left};
  };
  std::vector<Contender> contenders = {contender(own.hypothesis, found, net)};
  for (const auto& [family, rival] : rivals) {
    contenders.push_back(contender(rival.hypothesis, rival.trial, rival.distance));
  }
  const std::vector<double> shares = selected_shares(system, contenders, seed);
  naming.selected = shares.front();
  std::size_t place = 1;
  for (auto& [family, rival] : rivals) rival.selected = shares[place++];
}

}  // namespace

double Naming::stability() const {
  double share = selected;
  for (const Rival& rival : rivals) {
    const bool beside = std::find(families.begin(), families.end(), rival.family) != families.end();
    if (beside) share += rival.selected;
  }
  return share;
}

void conclude(Naming& naming) {
  std::stable_sort(naming.rivals.begin(), naming.rivals.end(),
                   [](const Rival& a, const Rival& b) { return a.distance < b.distance; });
  naming.families.resize(1);
  double rest = 0;
  for (const Rival& rival : naming.rivals) {
    const double distance = std::min(rival.distance, rival.apart);
    rest += std::exp(-std::clamp(distance, -200.0, 200.0) / (2 * kCaution));
    if (rival.distance < kApart || rival.apart < kSeparable) {
      naming.families.push_back(rival.family);
    }
  }
  rest += std::exp(-std::clamp(naming.unnamed_distance, -200.0, 200.0) / (2 * kCaution));
  naming.probability = 1 / (1 + rest);
}

Naming name_winner(const EffectRecordings& data, EffectSignals& signals,
                   const std::vector<Hypothesis>& hypotheses, const CompetitionResult& result,
                   std::size_t winner, const EvidenceSystem::Options& options) {
  const EvidenceSystem system = system_without(data, signals, hypotheses, result, winner, options);
  const ScaleTable scales(data);
  const Winner& own = result.winners[winner];
  Naming naming;
  const std::string& family = hypotheses[own.hypothesis].effect.law.family;
  naming.families = {family};
  double best = 0;
  TrialScore found = own.trial;  // the winner's own
  const JointColumns torque =
      system.whitened(effect_columns(data, signals, result.fit.point.effects[winner], {0}));
  std::vector<Rival> rivals;  // distance: what they explain, net
  for (const std::size_t rival : rivals_of(own, hypotheses)) {
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
    const double net = net_of(hypothesis, trial, result.noise);
    if (rival == own.hypothesis) {
      best = net;
      naming.lambda = std::max(0.0, trial.score.squares - trial.score.degrees);
      naming.delta_bic = -net;
      naming.part_left = trial.score.part_left;
      found = std::move(trial);
    } else if (trial.admissible && hypothesis.effect.law.family != family) {
      rivals.push_back({hypothesis.effect.law.family, short_name(hypothesis.effect), net, 0, rival,
                        std::move(trial), 0});
    }
  }
  drop_what_adds_nothing(rivals, hypotheses, family, best);
  std::map<std::string, Rival> best_of = best_of_families(std::move(rivals));
  for (auto& [other, rival] : best_of) {
    const Hypothesis& hypothesis = hypotheses[rival.hypothesis];
    rival.apart =
        imitation(system, torque,
                  hypothesis_columns(data, signals, system, hypothesis, rival.trial.effect))
            .left;
  }
  if (!hypotheses[own.hypothesis].windowed) {
    select_from_halves(data, signals, system, hypotheses, own, found, best, options.seed, naming,
                       best_of);
  }
  UnnamedRival unnamed =
      unnamed_rival(data, signals, hypotheses, result, own, found.effect, system);
  naming.unnamed = std::move(unnamed.what);
  naming.unnamed_distance = best - unnamed.net;
  for (auto& [other, rival] : best_of) {
    rival.distance = best - rival.distance;
    naming.rivals.push_back(std::move(rival));
  }
  conclude(naming);
  return naming;
}

namespace {

/// Adds to the distance of the nearest rival what held-out recordings say, and puts it in the
/// winner's place if it is better then.
void settle(const EffectRecordings& train, const EffectRecordings& fitted,
            const EffectRecordings& heldout, EffectSignals& signals,
            const std::vector<Hypothesis>& hypotheses, CompetitionResult& result,
            std::size_t winner, const EvidenceSystem::Options& options, Naming& naming) {
  Rival& nearest = naming.rivals.front();
  std::optional<EffectFit> other;
  const bool refuted =
      result.noise.from_periods &&
      scatter_refutes(train, signals,
                      system_without(train, signals, hypotheses, result, winner, options),
                      hypotheses[nearest.hypothesis], nearest.trial.effect);
  if (!refuted) other = with_rival(fitted, result, winner, nearest);
  if (!other) {
    naming.rivals.erase(naming.rivals.begin());
    return;
  }
  const double gain = heldout_gain(heldout, result.noise, result.fit.point, other->point);
  nearest.distance -= gain;
  if (nearest.distance > -kEven) return;
  Winner& own = result.winners[winner];
  const std::string family = hypotheses[own.hypothesis].effect.law.family;
  own.hypothesis = nearest.hypothesis;
  own.trial = own.others[nearest.hypothesis].best;  // squares beside those of its round
  own.trial.effect = nearest.trial.effect;
  result.fit = *other;
  naming = name_winner(train, signals, hypotheses, result, winner, options);
  for (Rival& rival : naming.rivals) {
    if (rival.family == family) rival.distance += gain;
  }
}

}  // namespace

std::vector<Naming> settle_names(const EffectRecordings& train, const EffectRecordings& fitted,
                                 const EffectRecordings& heldout, EffectSignals& signals,
                                 const std::vector<Hypothesis>& hypotheses,
                                 CompetitionResult& result, const EvidenceSystem::Options& options,
                                 const CompetitionProgress& progress) {
  std::vector<Naming> namings;
  for (std::size_t i = 0; i < result.winners.size(); ++i) {
    if (progress) {
      progress("names", static_cast<double>(i) / static_cast<double>(result.winners.size()));
    }
    Naming naming = name_winner(train, signals, hypotheses, result, i, options);
    if (!naming.rivals.empty() && naming.rivals.front().distance < kApart) {
      settle(train, fitted, heldout, signals, hypotheses, result, i, options, naming);
      conclude(naming);
    }
    namings.push_back(std::move(naming));
  }
  return namings;
}

}  // namespace dyngen::runtime
