// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/naming.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "runtime/diagnosis/competition/heldout.h"
#include "runtime/diagnosis/competition/nameless_proof.h"
#include "runtime/diagnosis/competition/sandwich_test.h"
#include "runtime/diagnosis/competition/tie_rule.h"
#include "runtime/diagnosis/names/rivals.h"
#include "runtime/diagnosis/names/stability.h"
#include "runtime/diagnosis/names/unnamed_rival.h"
#include "runtime/diagnosis/scans/in_parallel.h"
#include "runtime/estimation/decompositions.h"

namespace dyngen::runtime {
namespace {

/// Errors of the noise model and of the linearisation widen differences of chi-square beyond
/// theory. Odds are computed from differences that are smaller by this factor.
constexpr double kCaution = 2;

constexpr std::size_t kWinnersAtOnce = 2;  // winners between two looks at the work that is done

/// Evidence of held-out recordings for a rival against a winner: the difference of their held-out
/// chi-squares, in units of the residual level where this exceeds the noise.
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
/// that the data do not determine speaks against it, or its torque is not finite.
std::optional<EffectFit> with_rival(const EffectRecordings& fitted, const CompetitionResult& result,
                                    std::size_t place, const Rival& rival) {
  std::vector<EffectInstance> effects = result.fit.point.effects;
  effects[place] = rival.trial.effect;
  try {
    EffectFit fit = fit_effects(fitted, effects, comparison_fit());
    for (const EffectRemark& remark : fit.remarks) {
      if (fit.objects(remark, static_cast<int>(place))) return std::nullopt;
    }
    return fit;
  } catch (const NotFiniteError&) {
    return std::nullopt;
  }
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
        trial.score.delta_chi2 - left};
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

/// What explains more than a winner in its place explains at least the difference beside it. The
/// winner's fit tells how much that is, also where the winner is not linear in its numbers (a long
/// delay), so that its columns explain less than it does.
void bound_advantages(const EffectRecordings& data, EffectSignals& signals,
                      const std::vector<Hypothesis>& hypotheses, const CompetitionResult& result,
                      const UnnamedRival& unnamed, const EvidenceSystem::Options& options,
                      Naming& naming) {
  const bool none = naming.unnamed_distance >= 0 &&
                    std::all_of(naming.rivals.begin(), naming.rivals.end(),
                                [](const Rival& rival) { return rival.distance >= 0; });
  if (none) return;
  const EvidenceSystem all =
      system_beside(data, signals, hypotheses, result, result.fit.point, result.noise, options);
  const auto bound = [&](double& distance, const JointColumns& columns) {
    if (distance >= 0) return;
    const double beside = score_of(all.products(columns, false), false).delta_chi2;
    distance = std::max(distance, -beside);
  };
  bound(naming.unnamed_distance, unnamed.columns);
  for (Rival& rival : naming.rivals) {
    if (rival.distance >= 0) continue;
    bound(rival.distance,
          hypothesis_columns(data, signals, all, hypotheses[rival.hypothesis], rival.trial.effect));
  }
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
  // a form that a condition rules out is a doubt and no better name, however much more it explains
  const double least = naming.unnamed_form.ruled_out ? kTie : -200.0;
  rest += std::exp(-std::clamp(naming.unnamed_distance, least, 200.0) / (2 * kCaution));
  naming.probability = 1 / (1 + rest);
}

Naming name_winner(const EffectRecordings& data, EffectSignals& signals,
                   const std::vector<Hypothesis>& hypotheses, const CompetitionResult& result,
                   std::size_t winner, const EvidenceSystem::Options& options) {
  const EvidenceSystem system = system_without(data, signals, hypotheses, result, winner, options);
  const Winner& own = result.winners[winner];
  const Hypothesis& hypothesis = hypotheses[own.hypothesis];
  RivalsOfWinner rivals = rivals_of(data, signals, hypotheses, result, winner, system);
  Naming naming;
  naming.families = {hypothesis.effect.law.family};
  const double best = rivals.net;
  naming.lambda = std::max(0.0, rivals.own.score.delta_chi2 - rivals.own.score.degrees);
  naming.delta_bic = -best;
  naming.part_left = rivals.own.score.part_left;
  naming.kin = std::move(rivals.kin);
  naming.forms = std::move(rivals.forms);
  naming.elsewhere = std::move(rivals.elsewhere);
  std::map<std::string, Rival> best_of = best_of_families(std::move(rivals.others));
  if (!hypothesis.windowed) {
    select_from_halves(data, signals, system, hypotheses, own, rivals.own, best, options.seed,
                       naming, best_of);
  }
  UnnamedRival unnamed =
      unnamed_rival(data, signals, hypotheses, result, own, rivals.own.effect, system);
  naming.unnamed = std::move(unnamed.what);
  naming.unnamed_form = std::move(unnamed.form);
  naming.unnamed_distance = best - unnamed.net;
  for (auto& [other, rival] : best_of) {
    rival.distance = best - rival.distance;
    naming.rivals.push_back(std::move(rival));
  }
  bound_advantages(data, signals, hypotheses, result, unnamed, options, naming);
  conclude(naming);
  return naming;
}

namespace {

/// Who stands in a winner's place once everything is found: what its round chose, or another.
class Places {
 public:
  Places(const NamingData& data, EffectSignals& signals, CompetitionResult& result)
      : data_(data), signals_(signals), result_(result) {}

  /// Whether another effect came into a winner's place.
  [[nodiscard]] bool changed() const { return changed_; }

  /// @param fits  whether other names are fitted with all that was found; else they are compared
  ///              as the screening of the winner's round left them
  Naming named(std::size_t winner, bool fits) {
    Naming naming = name(winner);
    if (!fits) return naming;
    // another form of the same effect, beside all that was found since
    if (naming.kin && naming.kin->distance < -kTie) {
      const Rival kin = *naming.kin;
      const Challenge challenge = challenged(winner, kin);
      if (challenge.fit && kin.distance - challenge.gain < -kTie) {
        put_in_place(winner, kin, *challenge.fit);
        naming = name(winner);
      }
    }
    if (!naming.rivals.empty() && naming.rivals.front().distance < kApart) {
      settle(winner, naming);
      conclude(naming);
    }
    if (naming.unnamed_distance < kApart && !unnamed_predicts_better(winner, naming)) {
      naming.unnamed.clear();
      naming.unnamed_distance = std::numeric_limits<double>::infinity();
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
    return name_winner(data_.evidence, signals_, data_.hypotheses, result_, winner, data_.options);
  }

  Challenge challenged(std::size_t winner, const Rival& rival) {
    const bool refuted = result_.noise.from_periods &&
                         scatter_refutes(data_.evidence, signals_,
                                         system_without(data_.evidence, signals_, data_.hypotheses,
                                                        result_, winner, data_.options),
                                         data_.hypotheses[rival.hypothesis], rival.trial.effect);
    Challenge challenge;
    if (!refuted) challenge.fit = with_rival(data_.fit, result_, winner, rival);
    if (challenge.fit) {
      challenge.gain =
          heldout_gain(data_.heldout, result_.noise, result_.fit.point, challenge.fit->point);
    }
    return challenge;
  }

  /// Whether held-out recordings say more for what has no name, in a winner's place, than for the
  /// winner; also where they cannot speak of it.
  [[nodiscard]] bool unnamed_predicts_better(std::size_t winner, const Naming& naming) {
    const Nameless& unnamed = naming.unnamed_form;
    const Hypothesis& hypothesis = data_.hypotheses[result_.winners[winner].hypothesis];
    if (hypothesis.windowed || !is_provable(unnamed)) return true;
    CompetitionResult rest = result_;
    const std::size_t own = result_.winners[winner].hypothesis;
    const std::vector<int> joints = joints_of(hypothesis.effect, data_.evidence.joints());
    std::erase_if(rest.nameless,
                  [&](const Nameless& each) { return is_left_by(each, own, joints); });
    rest.winners.erase(rest.winners.begin() + static_cast<std::ptrdiff_t>(winner));
    rest.fit.point = without(rest.fit.point, winner);
    const ProofData recordings{data_.evidence, signals_, data_.heldout};
    const auto gain = [](const HeldoutProof& proof) { return proof.before - proof.after; };
    return gain(nameless_proof(recordings, data_.hypotheses, rest, rest.noise, unnamed,
                               data_.options)) >
           gain(effect_proof(recordings, data_.hypotheses, rest, rest.noise,
                             result_.fit.point.effects[winner], data_.options));
  }

  void put_in_place(std::size_t winner, const Rival& rival, const EffectFit& fit) {
    Winner& own = result_.winners[winner];
    for (Nameless& each : result_.nameless) {
      std::replace(each.beside.begin(), each.beside.end(), own.hypothesis, rival.hypothesis);
    }
    own.hypothesis = rival.hypothesis;
    own.trial = own.others[rival.hypothesis].best;  // chi-square reduction within its round
    own.trial.effect = rival.trial.effect;
    result_.fit = fit;
    changed_ = true;
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
    if (nearest.distance > -kTie) return;
    const std::string family =
        data_.hypotheses[result_.winners[winner].hypothesis].effect.law.family;
    put_in_place(winner, Rival(nearest), *challenge.fit);
    naming = name(winner);
    for (Rival& rival : naming.rivals) {
      if (rival.family == family) rival.distance += challenge.gain;
    }
  }

  const NamingData& data_;
  EffectSignals& signals_;
  CompetitionResult& result_;
  bool changed_ = false;
};

/// What one winner is called, and everything once it is.
struct NamedPlace {
  Naming naming;
  bool changed = false;  ///< then result is another
  CompetitionResult result;
};

}  // namespace

std::vector<Naming> settle_names(const NamingData& data, EffectSignals& signals,
                                 CompetitionResult& result, const CompetitionProgress& progress) {
  std::vector<Naming> namings;
  const std::size_t count = result.winners.size();
  const std::size_t threads = std::min({working_threads(), count, kWinnersAtOnce});
  std::vector<EffectSignals> others(threads > 0 ? threads - 1 : 0, EffectSignals(data.evidence));
  while (namings.size() < count) {
    const std::size_t first = namings.size();
    if (progress) progress("names", static_cast<double>(first) / static_cast<double>(count));
    // several winners at once, each as if those before it kept their places
    const bool fits = !data.effort.spent("fits of other names", result.cut_off);
    std::vector<NamedPlace> named(std::min(kWinnersAtOnce, count - first));
    in_parallel(named.size(), threads, [&](std::size_t i, std::size_t thread) {
      NamedPlace& own = named[i];
      own.result = result;
      EffectSignals& reader = thread == 0 ? signals : others[thread - 1];
      Places places(data, reader, own.result);
      own.naming = places.named(first + i, fits);
      own.changed = places.changed();
    });
    for (NamedPlace& own : named) {
      namings.push_back(std::move(own.naming));
      if (!own.changed) continue;
      result = std::move(own.result);
      break;  // those behind it are asked again
    }
  }
  return namings;
}

}  // namespace dyngen::runtime
