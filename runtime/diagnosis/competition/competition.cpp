// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/competition.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "runtime/diagnosis/competition/acceptance.h"
#include "runtime/diagnosis/competition/beside_white_noise.h"
#include "runtime/diagnosis/competition/effect_conditions.h"
#include "runtime/diagnosis/competition/effort.h"
#include "runtime/diagnosis/competition/event_links.h"
#include "runtime/diagnosis/competition/likely_search.h"
#include "runtime/diagnosis/competition/nameless_search.h"
#include "runtime/diagnosis/competition/pair_search.h"
#include "runtime/diagnosis/competition/ranked_effects.h"
#include "runtime/diagnosis/competition/second_scan.h"
#include "runtime/diagnosis/competition/stiction_impulses.h"
#include "runtime/diagnosis/scans/largest_model.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr const char* kLikelihoods = "likelihoods of effects";
constexpr std::size_t kRivals = 5;  // that are compared again once the winner is fitted

/// One competition's data and what was found so far.
class Competition {
 public:
  Competition(const CompetitionData& data, const std::vector<Hypothesis>& hypotheses,
              const CompetitionOptions& options, const CompetitionProgress& progress)
      : data_(data),
        sought_(sought_in(data.evidence, hypotheses)),
        options_(options),
        progress_(progress),
        screening_data_(data.evidence),
        repeats_(repeats_of(data.fit)),
        stiction_(data_, sought_, result_.sticking, options_.false_alarm),
        conditions_(data_, sought_, stiction_, result_),
        links_(data_, sought_, conditions_, options_.false_alarm, result_),
        nameless_(data_, sought_, stiction_, system_options(), options_.false_alarm, result_),
        likely_(data_, sought_, screening_data_, result_,
                {[this](const EffectInstance& effect) { return fit(effects_and(effect)); },
                 [this] { return exhausted(kLikelihoods); }}),
        pairs_(data_, sought_, stiction_, conditions_, options_.false_alarm, result_),
        acceptance_(data_, sought_, system_options(), options_.false_alarm, result_),
        judges_{data_, sought_, stiction_, conditions_, nameless_, result_, options_.false_alarm} {}

  CompetitionResult run() {
    tell("the model alone", 0);
    result_.base = result_.fit = fit({});
    for (int round = 0;; ++round) {
      measure_noise();
      acceptance_.begin_round();
      const EvidenceSystem system = model_system();
      std::vector<GenericResult> structure;
      if (round == 0 && asks_for_stiction()) {
        structure = screen_structures(system);
        if (!result_.sticking.empty()) return std::move(result_);
      }
      Screening screening = screen_beside(system, round == 0, structure);
      if (round == 0) result_.first = screening;
      result_.last = screening;
      if (static_cast<int>(result_.winners.size()) >= options_.most_winners) {
        result_.cut_off.push_back(
            fmt::format("effects beyond the first {}", options_.most_winners));
        break;
      }
      if (exhausted("further effects")) break;
      const bool found = result_.noise.free_of_structure() ? next(system, screening)
                                                           : next_likely(system, screening);
      if (!found) break;
      if (options_.until_stiction && !result_.sticking.empty()) return std::move(result_);
    }
    drop_superfluous();
    if (!result_.winners.empty() && !exhausted("frequencies of what was found") &&
        scan_again(data_, sought_, system_options(), result_)) {
      result_.fit = fit(effects());
    }
    return std::move(result_);
  }

 private:
  void tell(const std::string& stage, double done) const {
    if (progress_) progress_(stage, done);
  }

  /// Whether the work that may be done is done; then a search is left out, and named.
  bool exhausted(const std::string& search) {
    return Effort(options_.effort, data_.evidence.work).spent(search, result_.cut_off);
  }

  [[nodiscard]] std::vector<EffectInstance> effects_and(const EffectInstance& effect) const {
    std::vector<EffectInstance> all = effects();
    all.push_back(effect);
    return all;
  }

  /// May be called from several threads.
  EffectFit fit(const std::vector<EffectInstance>& effects) const {
    return fit_effects(data_.fit, effects, comparison_fit());
  }

  /// Effects of all winners, with their latest estimates.
  [[nodiscard]] std::vector<EffectInstance> effects() const { return result_.fit.point.effects; }

  void measure_noise() {
    const RunResiduals residuals = residuals_of(data_.fit, result_.fit.point);
    const auto noise_of = [&](const RunResiduals& left, const std::vector<JointColumns>& largest) {
      return torque_noise_model(data_.fit, left, repeats_, options_.with_regressor,
                                options_.rules.noise, largest);
    };
    result_.noise = noise_of(residuals, {});
    if (result_.noise.from_periods) return;
    EffectSignals signals(data_.fit);
    signals.set_beta(result_.fit.point.beta);
    // what another simulator leaves has no model of its own, beside which a larger one would stand
    std::vector<JointColumns> largest;
    if (options_.with_regressor) {
      largest = largest_model(data_.fit, signals, options_.rules.equations);
    }
    if (!largest.empty()) {
      // structure that was found without a name is no noise either
      for (const Nameless& nameless : result_.nameless) {
        const JointColumns own = nameless_columns(data_.fit, signals, nameless);
        for (std::size_t i = 0; i < own.joints.size(); ++i) {
          largest.push_back(columns_of_joint(own.joints[i], own.parts[i]));
        }
      }
      result_.noise = noise_of(residuals, largest);
    } else if (!result_.nameless.empty()) {
      // noise is what the model leaves: structure that was found is none of it
      const EvidenceSystem white =
          beside_white_noise(data_.fit, signals, sought_.hypotheses, result_, system_options());
      result_.noise = noise_of(rests_of(data_.fit, white, result_.fit.rms), {});
    }
  }

  [[nodiscard]] EvidenceSystem::Options system_options() const {
    EvidenceSystem::Options options;
    options.seed = options_.seed;
    options.with_regressor = options_.with_regressor;
    options.rules = options_.rules;
    return options;
  }

  /// Whether it is asked at once which joints rest, before any effect is looked at.
  [[nodiscard]] bool asks_for_stiction() const {
    // where nothing repeats, what sticks leave is taken for noise, in which nothing is seen
    return options_.until_stiction && (options_.sticks || !result_.noise.free_of_structure());
  }

  /// Structures alone, and which joints rest by them.
  std::vector<GenericResult> screen_structures(const EvidenceSystem& system) {
    Screening structure =
        screen(screening_data_, system, sought_.scales, result_.fit.point.beta, {},
               sought_.structures, nullptr, [&](double done) { tell("joints that stick", done); });
    result_.sticking = stiction_.strongest(system, structure);
    return std::move(structure.generic);
  }

  EvidenceSystem model_system() {
    return system_beside(data_.evidence, data_.signals, sought_.hypotheses, result_,
                         result_.fit.point, result_.noise, system_options());
  }

  /// @param first  the whole grid of shapes is tried
  /// @param known  as of screen()
  Screening screen_beside(const EvidenceSystem& system, bool first,
                          const std::vector<GenericResult>& known = {}) {
    const std::string stage =
        first ? "structure beside the model" : "structure beside the model and what was found";
    return screen(
        screening_data_, system, sought_.scales, result_.fit.point.beta, sought_.hypotheses,
        sought_.structures, first ? nullptr : &result_.first,
        [&](double done) { tell(stage, done); }, known);
  }

  [[nodiscard]] double net(const NamedResult& result) const {
    return sought_.net(result, result_.noise);
  }

  /// Whatever a round finds: an effect, a pair of them, joints that rest, structure without a name.
  /// An effect beside which something without a name explains more is asked once nothing else is
  /// found: the rest of the structure may be that of other effects.
  bool next(const EvidenceSystem& system, Screening& screening) {
    RankedEffects ranked = ranked_effects(system, screening);
    return next_winner(ranked, system, screening) || next_pair(system, screening) ||
           take(nameless_.sticking(system, screening)) ||
           next_of(ranked, true, system, screening) || take(nameless_.next(system, screening));
  }

  RankedEffects ranked_effects(const EvidenceSystem& system, Screening& screening) {
    return {judges_, system, screening, screening_data_,
            [&](double done) { tell("shapes of the strongest effects", done); }};
  }

  bool next_winner(RankedEffects& ranked, const EvidenceSystem& system,
                   const Screening& screening) {
    if (next_of(ranked, false, system, screening)) return true;
    if (take(acceptance_.accept_at_bound(screening))) return true;
    return ranked.costly() && keep_without_name(*ranked.costly(), system, screening);
  }

  /// @param outdone  of RankedEffects::next()
  bool next_of(RankedEffects& ranked, bool outdone, const EvidenceSystem& system,
               const Screening& screening) {
    while (const std::optional<RankedEffect> own = ranked.next(outdone)) {
      const NamedResult best = links_.on_nearest(
          settled(screening.named[own->hypothesis], ranked.order(), ranked.stopped(), screening),
          system, screening, ranked.attempted());
      ranked.tried(best.hypothesis);
      const bool at_stiction = own->stiction == StictionImpulses::Part::kBecause;
      if (accept(best, screening, at_stiction, own->beside)) return true;
    }
    return false;
  }

  /// What was found becomes part of the result. @return whether anything was found
  bool take(std::optional<Acceptance::Accepted> accepted) {
    if (!accepted) return false;
    result_.winners.push_back(std::move(accepted->winner));
    result_.fit = std::move(accepted->fit);
    return true;
  }
  bool take(std::optional<Nameless> nameless) {
    if (!nameless) return false;
    for (const Winner& winner : result_.winners) nameless->beside.push_back(winner.hypothesis);
    result_.nameless.push_back(std::move(*nameless));
    return true;
  }
  bool take(const std::vector<StictionJoint>& sticking) {
    result_.sticking.insert(result_.sticking.end(), sticking.begin(), sticking.end());
    return !sticking.empty();
  }

  /// Two effects of which neither is found while the other is left out.
  bool next_pair(const EvidenceSystem& system, const Screening& screening) {
    if (static_cast<int>(result_.winners.size()) + 2 > options_.most_winners) return false;
    if (exhausted("pairs of effects")) return false;
    for (const EffectPair& pair : pairs_.strongest(system, screening)) {
      if (exhausted("pairs of effects")) return false;
      if (pairs_.promising(pair, system, screening) && find_both(pair, screening)) return true;
    }
    return false;
  }

  /// Each of a pair has to be found beside the other. @return whether both are in the result now;
  /// else the result is what it was
  bool find_both(const EffectPair& pair, const Screening& screening) {
    const auto fit_pair = [&](const std::vector<EffectInstance>& all) {
      tell("pairs of effects", 0);
      return fit(all);
    };
    const std::size_t found = result_.winners.size();
    CompetitionResult before = result_;
    // one stands in until the other is found, then it has to be found itself
    result_.winners.emplace_back().hypothesis = pair.weaker;
    result_.fit = fit_pair(effects_and(screening.named[pair.weaker].freest.effect));
    if (next_beside(found + 2)) {
      result_.winners.erase(result_.winners.begin() + static_cast<std::ptrdiff_t>(found));
      result_.fit = fit_pair(without(result_.fit.point, found).effects);
      if (next_beside(found + 2)) return true;
    }
    before.cut_off = std::move(result_.cut_off);
    result_ = std::move(before);
    return false;
  }

  /// One winner more beside those that there are. @param wanted  how many there are to be
  bool next_beside(std::size_t wanted) {
    acceptance_.begin_round();
    const EvidenceSystem system = model_system();
    Screening screening = screen_beside(system, false);
    RankedEffects ranked = ranked_effects(system, screening);
    return next_winner(ranked, system, screening) && result_.winners.size() == wanted;
  }

  /// An effect that is far more than noise and helps on held-out recordings, but has more
  /// parameters than its squares pay for, is structure without a name; once.
  bool keep_without_name(std::size_t place, const EvidenceSystem& system,
                         const Screening& screening) {
    const NamedResult& named = screening.named[place];
    const std::string name = short_name(named.best.effect);
    if (!nameless_.sure(screening, named.surprise) || nameless_.is_costly(name)) return false;
    if (stiction_.explain(system, screening, sought_.hypotheses[place], named)) return false;
    const GenericResult* nearest = nullptr;
    for (const int joint : sought_.joints(place)) {
      for (const GenericResult& generic : screening.generic) {
        const GenericStructure& structure = sought_.structures[generic.structure];
        if (structure.joint != joint || !structure.is_specific() ||
            structure.form == GenericStructure::Form::kImpulses || has_nameless(result_, joint))
          continue;
        if (!nearest || generic.surprise > nearest->surprise) nearest = &generic;
      }
    }
    if (!nearest || !acceptance_.proof_of(with(named.best.effect)).helps()) return false;
    return take(nameless_.described(*nearest, system, name));
  }

  /// Where no motion repeats: see LikelySearch and likeliest_structure().
  bool next_likely(const EvidenceSystem& system, const Screening& screening) {
    tell("likelihoods", 0);
    const EvidenceSystem white = beside_white_noise(data_.evidence, data_.signals,
                                                    sought_.hypotheses, result_, system_options());
    const Screening beside = screen(screening_data_, white, sought_.scales, result_.fit.point.beta,
                                    sought_.hypotheses, sought_.structures, &result_.first);
    const ModelSide plain{white, beside};
    const auto accepts = [&](const LikelyEffect& likely) {
      if (screening.family_wise(likely.named.surprise) > options_.false_alarm) return false;
      if (likely.net < stiction_.unseen_on(sought_.joints(likely.named.hypothesis))) {
        return false;
      }
      const StictionImpulses::Part stiction = stiction_.part_in(
          white, beside, sought_.hypotheses[likely.named.hypothesis], likely.named);
      if (stiction == StictionImpulses::Part::kAll ||
          conditions_.is_no_event(white, likely.named) ||
          is_part_of_found_event(result_, sought_.hypotheses, likely.named.hypothesis,
                                 likely.named.best.effect)) {
        return false;
      }
      const bool at_stiction = stiction == StictionImpulses::Part::kBecause;
      const NamedResult nearest = links_.on_nearest(likely.named, white, beside, {});
      if (nearest.hypothesis != likely.named.hypothesis &&
          accept(nearest, screening, at_stiction)) {
        return true;
      }
      return accept(likely.named, screening, at_stiction, likely.fit);
    };
    if (likely_.next({system, screening}, plain, accepts)) return true;
    // what an effect that was not looked at explains is not without a name
    if (exhausted(kLikelihoods)) return false;
    return take(nameless_.sticking(system, screening)) || take(nameless_.next(system, screening)) ||
           take(nameless_.next_likely(plain));
  }

  /// What effects read of the model (the load on a gear) is wrong as long as the model has taken up
  /// a part of the effect: the winner and its rivals are compared again beside the model as it is
  /// together with the winner.
  /// @param refused  those that were turned down in this round
  [[nodiscard]] NamedResult settled(const NamedResult& named, const std::vector<std::size_t>& order,
                                    const std::set<std::size_t>& refused,
                                    const Screening& screening) {
    if (exhausted("rivals of what was found")) return named;
    tell("rivals of " + short_name(named.best.effect), 0);
    std::vector<EffectInstance> all = effects();
    all.push_back(named.best.effect);
    const EffectPoint beside = without(fit(all).point, all.size() - 1);
    EvidenceSystem::Options options = system_options();
    options.surrogates = 0;
    const EvidenceSystem system = system_beside(data_.evidence, data_.signals, sought_.hypotheses,
                                                result_, beside, result_.noise, options);
    NamedResult best = named;
    bool first = true;
    std::size_t tried = 0;
    for (const std::size_t place : order) {
      if (tried++ == kRivals) break;
      const NamedResult& rival = screening.named[place];
      if (refused.contains(place)) continue;
      if (rival.best.score.delta_chi2 < kLeastAsGood * named.best.score.delta_chi2) continue;
      const Hypothesis& hypothesis = sought_.hypotheses[place];
      const EffectScales scales = sought_.scales.of(beside.beta, hypothesis.effect);
      EffectInstance start = rival.best.effect;
      for (const int p : hypothesis.linear) start.parameters[p] = hypothesis.effect.parameters[p];
      NamedResult again = rival;
      again.best = refined(
          data_.evidence, data_.signals, system, hypothesis,
          try_hypothesis(data_.evidence, data_.signals, system, hypothesis, start, scales, false),
          scales);
      if (!again.best.admissible) continue;
      again.surprise = surprise_of_refined(again, hypothesis);
      const double gain = net(again) - net(best);
      const bool better = gain > kTie || (gain > -kTie && sought_.parameters(place) <
                                                              sought_.parameters(best.hypothesis));
      if (first || better) best = std::move(again);
      first = false;
    }
    return best;
  }

  /// Fits the model with one more effect, and keeps it if nothing speaks against it.
  bool accept(const NamedResult& named, const Screening& screening, bool at_stiction,
              EffectConditions::Beside beside = EffectConditions::Beside::kNothing) {
    if (screening.family_wise(named.surprise) > options_.false_alarm) return false;
    return accept(named, screening, at_stiction, with(named.best.effect), beside);
  }
  bool accept(const NamedResult& named, const Screening& screening, bool at_stiction, EffectFit fit,
              EffectConditions::Beside beside = EffectConditions::Beside::kNothing) {
    // beside what explains more nothing is beyond doubt
    const bool beyond_doubt =
        beside == EffectConditions::Beside::kNothing && nameless_.sure(screening, named.surprise);
    return take(
        acceptance_.accept({named, std::move(fit), beyond_doubt, at_stiction, beside}, screening));
  }

  EffectFit with(const EffectInstance& effect) {
    tell("the model with " + short_name(effect), 0);
    return fit(effects_and(effect));
  }

  /// A winner that the others made superfluous leaves.
  void drop_superfluous() {
    for (std::size_t i = 0; i < result_.winners.size();) {
      const EvidenceSystem system = system_without(
          data_.evidence, data_.signals, sought_.hypotheses, result_, i, system_options());
      const Hypothesis& hypothesis = sought_.hypotheses[result_.winners[i].hypothesis];
      const TrialScore again = try_hypothesis(
          data_.evidence, data_.signals, system, hypothesis, result_.fit.point.effects[i],
          sought_.scales.of(result_.fit.point.beta, hypothesis.effect), false);
      const double surprise = surprise_of(again.score.delta_chi2, again.score.degrees);
      if (result_.last.family_wise(surprise) <= options_.false_alarm) {
        ++i;
        continue;
      }
      const EffectPoint rest = without(result_.fit.point, i);
      result_.winners.erase(result_.winners.begin() + static_cast<std::ptrdiff_t>(i));
      result_.fit = fit(rest.effects);
      i = 0;
    }
  }

  CompetitionData data_;
  Sought sought_;
  CompetitionOptions options_;
  const CompetitionProgress& progress_;
  ScreeningData screening_data_;
  std::vector<double> repeats_;
  CompetitionResult result_;
  StictionImpulses stiction_;
  EffectConditions conditions_;
  EventLinks links_;
  NamelessSearch nameless_;
  LikelySearch likely_;
  PairSearch pairs_;
  Acceptance acceptance_;
  RoundJudges judges_;
};

}  // namespace

CompetitionResult compete(const CompetitionData& data, const std::vector<Hypothesis>& hypotheses,
                          const CompetitionOptions& options, const CompetitionProgress& progress) {
  return Competition(data, hypotheses, options, progress).run();
}

}  // namespace dyngen::runtime
