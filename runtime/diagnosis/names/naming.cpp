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
#include "runtime/diagnosis/names/rival_families.h"
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

/// Of each joint the nearest, where these data do not tell it from the winner's.
/// @param elsewhere  distance is by what they are worse
std::vector<Rival> nearest_of_joints(std::vector<Rival> elsewhere,
                                     const std::vector<Hypothesis>& hypotheses) {
  std::map<int, Rival> nearest;
  for (Rival& rival : elsewhere) {
    if (rival.distance >= kApart && rival.apart >= kSeparable) continue;
    const auto [entry, added] =
        nearest.try_emplace(hypotheses[rival.hypothesis].effect.joint, rival);
    if (!added && rival.distance < entry->second.distance) entry->second = std::move(rival);
  }
  std::vector<Rival> all;
  for (auto& [joint, rival] : nearest) all.push_back(std::move(rival));
  return all;
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
  std::vector<Rival> rivals, elsewhere;  // distance: what they explain, net
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
    } else if (trial.admissible) {
      Rival other{hypothesis.effect.law.family,
                  short_name(hypothesis.effect),
                  net,
                  0,
                  rival,
                  std::move(trial),
                  0};
      if (other.family != family) {
        rivals.push_back(std::move(other));
      } else if (hypothesis.effect.joint != hypotheses[own.hypothesis].effect.joint) {
        elsewhere.push_back(std::move(other));
      } else if (!naming.kin || other.distance > naming.kin->distance) {
        naming.kin = std::move(other);
      }
    }
  }
  if (naming.kin) naming.kin->distance = best - naming.kin->distance;
  drop_what_adds_nothing(rivals, hypotheses, family, best);
  const auto apart = [&](const Rival& rival) {
    const Hypothesis& hypothesis = hypotheses[rival.hypothesis];
    return imitation(system, torque,
                     hypothesis_columns(data, signals, system, hypothesis, rival.trial.effect))
        .left;
  };
  for (Rival& rival : rivals) rival.apart = apart(rival);
  for (Rival& rival : elsewhere) {
    rival.apart = apart(rival);
    rival.distance = best - rival.distance;
  }
  naming.elsewhere = nearest_of_joints(std::move(elsewhere), hypotheses);
  std::map<std::string, Rival> best_of = best_of_families(std::move(rivals));
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

/// Who stands in a winner's place once everything is found: what its round chose, or another.
class Places {
 public:
  Places(const EffectRecordings& train, const EffectRecordings& fitted,
         const EffectRecordings& heldout, EffectSignals& signals,
         const std::vector<Hypothesis>& hypotheses, CompetitionResult& result,
         const EvidenceSystem::Options& options)
      : train_(train),
        fitted_(fitted),
        heldout_(heldout),
        signals_(signals),
        hypotheses_(hypotheses),
        result_(result),
        options_(options) {}

  Naming named(std::size_t winner) {
    Naming naming = name(winner);
    // another form of the same effect, beside all that was found since
    if (naming.kin && naming.kin->distance < -kEven) {
      const Rival kin = *naming.kin;
      const Challenge challenge = challenged(winner, kin);
      if (challenge.fit && kin.distance - challenge.gain < -kEven) {
        put_in_place(winner, kin, *challenge.fit);
        naming = name(winner);
      }
    }
    if (!naming.rivals.empty() && naming.rivals.front().distance < kApart) {
      settle(winner, naming);
      conclude(naming);
    }
    return naming;
  }

 private:
  /// The model with a rival in a winner's place, and what held-out recordings say for it; no fit
  /// where something speaks against it.
  struct Challenge {
    std::optional<EffectFit> fit;
    double gain = 0;
  };

  [[nodiscard]] Naming name(std::size_t winner) {
    return name_winner(train_, signals_, hypotheses_, result_, winner, options_);
  }

  Challenge challenged(std::size_t winner, const Rival& rival) {
    const bool refuted =
        result_.noise.from_periods &&
        scatter_refutes(train_, signals_,
                        system_without(train_, signals_, hypotheses_, result_, winner, options_),
                        hypotheses_[rival.hypothesis], rival.trial.effect);
    Challenge challenge;
    if (!refuted) challenge.fit = with_rival(fitted_, result_, winner, rival);
    if (challenge.fit) {
      challenge.gain =
          heldout_gain(heldout_, result_.noise, result_.fit.point, challenge.fit->point);
    }
    return challenge;
  }

  void put_in_place(std::size_t winner, const Rival& rival, const EffectFit& fit) {
    Winner& own = result_.winners[winner];
    own.hypothesis = rival.hypothesis;
    own.trial = own.others[rival.hypothesis].best;  // squares beside those of its round
    own.trial.effect = rival.trial.effect;
    result_.fit = fit;
  }

  /// Adds to the distance of the nearest rival what held-out recordings say, and puts it in the
  /// winner's place if it is better then.
  void settle(std::size_t winner, Naming& naming) {
    Rival& nearest = naming.rivals.front();
    const Challenge challenge = challenged(winner, nearest);
    if (!challenge.fit) {
      naming.rivals.erase(naming.rivals.begin());
      return;
    }
    nearest.distance -= challenge.gain;
    if (nearest.distance > -kEven) return;
    const std::string family = hypotheses_[result_.winners[winner].hypothesis].effect.law.family;
    put_in_place(winner, Rival(nearest), *challenge.fit);
    naming = name(winner);
    for (Rival& rival : naming.rivals) {
      if (rival.family == family) rival.distance += challenge.gain;
    }
  }

  const EffectRecordings& train_;
  const EffectRecordings& fitted_;
  const EffectRecordings& heldout_;
  EffectSignals& signals_;
  const std::vector<Hypothesis>& hypotheses_;
  CompetitionResult& result_;
  const EvidenceSystem::Options& options_;
};

}  // namespace

std::vector<Naming> settle_names(const EffectRecordings& train, const EffectRecordings& fitted,
                                 const EffectRecordings& heldout, EffectSignals& signals,
                                 const std::vector<Hypothesis>& hypotheses,
                                 CompetitionResult& result, const EvidenceSystem::Options& options,
                                 const CompetitionProgress& progress) {
  Places places(train, fitted, heldout, signals, hypotheses, result, options);
  std::vector<Naming> namings;
  for (std::size_t i = 0; i < result.winners.size(); ++i) {
    if (progress) {
      progress("names", static_cast<double>(i) / static_cast<double>(result.winners.size()));
    }
    namings.push_back(places.named(i));
  }
  return namings;
}

}  // namespace dyngen::runtime
