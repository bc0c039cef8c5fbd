// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/changes/changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "runtime/diagnosis/changes/change_posterior.h"
#include "runtime/effects/effect_residual.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTheorem = 1e-6;  // part of an effect's chi-square that the model leaves
constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

EffectRecordings together(const EffectRecordings& reference, const EffectRecordings& later) {
  EffectRecordings all = reference;
  all.runs.insert(all.runs.end(), later.runs.begin(), later.runs.end());
  for (EffectRun& run : all.runs) run.earlier.reset();
  return all;
}

SessionPlan plan_of(const ComparedSessions& compared) {
  SessionPlan plan;
  std::map<int, int> before, after;
  const auto place = [](std::map<int, int>& files, int file) {
    return files.try_emplace(file, static_cast<int>(files.size())).first->second;
  };
  for (const EffectRun& run : compared.reference.runs) {
    plan.of_run.push_back(place(before, run.recording));
  }
  plan.reference = static_cast<int>(before.size());
  for (const EffectRun& run : compared.later.runs) {
    const auto recording = static_cast<std::size_t>(run.recording);
    const int file =
        recording < compared.later_files.size() ? compared.later_files[recording] : run.recording;
    plan.of_run.push_back(plan.reference + place(after, file));
  }
  plan.later = static_cast<int>(after.size());
  return plan;
}

/// Torque less the model and effects of both sides, with parameters of each session's own.
/// @param nb       parameters of the model
/// @param further  columns beside the regressor, of which the first `shared` are of both sides
RunResiduals residuals_of_sessions(const std::vector<RowBlock>& blocks, const SessionPlan& plan,
                                   const std::vector<JointNoise>& noise, Index nb,
                                   const JointColumns& further, Index shared) {
  const MatrixXd beta =
      estimates_of_sessions(session_equations(blocks, plan, noise, further), nb + shared);
  RunResiduals residuals;
  Index start = 0;
  for (std::size_t run = 0; run < blocks.size(); ++run) {
    const VectorXd own = beta.col(plan.of_run[run]);
    MatrixXd left = residual(blocks[run], own.head(nb));
    for (std::size_t part = 0; part < further.parts.size(); ++part) {
      left.col(further.joints[part]) -=
          further.parts[part].block(start, 0, left.rows(), shared) * own.tail(shared);
    }
    start += left.rows();
    residuals.push_back(std::move(left));
  }
  return residuals;
}

/// Linear effects that may have come after the reference: those that the model absorbs in one
/// recording, and what pulls or turns a joint.
std::vector<Hypothesis> possible(const std::vector<Hypothesis>& hypotheses,
                                 const CompetitionResult& result, bool loads) {
  std::vector<Hypothesis> effects;
  for (const NamedResult& named : result.first.named) {
    const Hypothesis& own = hypotheses[named.hypothesis];
    const EffectLaw& law = own.effect.law;
    const bool absorbed = named.part_left < kTheorem && named.typical.size() > 0;
    const bool linear = own.shapes.empty() && !own.windowed && law.states.empty() &&
                        law.alignment == AlignmentOperator::kNone && own.effect.recording < 0;
    const bool shapes = std::any_of(own.linear.begin(), own.linear.end(), [&](int p) {
      return law.parameters[static_cast<std::size_t>(p)].role != EffectRole::kLinear;
    });
    const bool excluded = shapes || law.reads("t") || law.reads("temp");
    if (!linear || excluded || (law.family == "payload" && loads)) continue;
    if (!absorbed && (law.dissipates || law.scope == EffectScope::kPair)) continue;
    if (is_winner(result, named.hypothesis)) continue;  // of both sides, or of one
    effects.push_back(own);
  }
  return effects;
}

std::string sentence_of(const SessionScatter& scatter, const SessionPlan& plan,
                        const std::vector<bool>& revolute) {
  constexpr std::array<const char*, kScatterKinds> kNames = {"Coulomb friction", "viscous friction",
                                                             "offsets"};
  const bool turns = std::find(revolute.begin(), revolute.end(), false) == revolute.end();
  constexpr std::array<const char*, kScatterKinds> kTurning = {" N m", " N m s/rad", " N m"};
  std::vector<std::string> parts;
  for (std::size_t kind = 0; kind < kScatterKinds; ++kind) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    const VectorXd deviations = scatter.deviations(1);
    for (std::size_t i = 0; i < scatter.terms.size(); ++i) {
      if (static_cast<std::size_t>(scatter.terms[i].kind) != kind) continue;
      least = std::min(least, deviations[static_cast<Index>(i)]);
      most = std::max(most, deviations[static_cast<Index>(i)]);
    }
    if (!(most > 0)) continue;
    parts.push_back(fmt::format("{} {:.2g} to {:.2g}{}", kNames[kind], least, most,
                                turns ? kTurning[kind] : ""));
  }
  std::string text = fmt::format("{} session{} of the reference, {} after it; ", plan.reference,
                                 plan.reference == 1 ? "" : "s", plan.later);
  text += scatter.estimated
              ? "standard deviation between sessions of one side, estimated: "
              : "one session on each side: the standard deviation that is allowed between them: ";
  text += fmt::format("{}", fmt::join(parts, ", "));
  if (scatter.inflation > 1.2) {
    text += fmt::format(
        "; sessions of one side, or halves of one, differ {:.1f} times as much as noise",
        std::sqrt(scatter.inflation));
  }
  return text + ".";
}

/// Mean temperature of a joint in the reference and after it; NaN where a recording has none.
std::pair<double, double> mean_temperatures(const EffectRecordings& all,
                                            const std::vector<bool>& later, int joint) {
  std::array<double, 2> sum{}, samples{};
  for (std::size_t run = 0; run < all.runs.size(); ++run) {
    const MatrixXd& temperature = all.runs[run].motion.temperature;
    if (temperature.size() == 0) return {kNotKnown, kNotKnown};
    const std::size_t side = later[run] ? 1 : 0;
    sum[side] += temperature.col(joint).sum();
    samples[side] += static_cast<double>(temperature.rows());
  }
  return {sum[0] / samples[0], sum[1] / samples[1]};
}

/// What warmth says of friction that changed; empty: nothing.
/// @param change  of friction at the usual speed: only its sign counts
std::string warmth_caveat(const std::pair<double, double>& temperatures, double change) {
  constexpr double kSame = 2;  // K: by which friction changes less than sessions scatter
  const auto [before, after] = temperatures;
  if (std::isnan(before)) {
    return change < 0 ? "a warmer arm has less friction too, and no column temp of both sides "
                        "tells that from wear"
                      : "a colder arm has more friction too, and no column temp of both sides "
                        "tells that from wear";
  }
  const double warmer = after - before;
  if (std::abs(warmer) < kSame || (warmer > 0) == (change > 0)) return {};
  return fmt::format(
      "the joint was {:.3g} degrees {} than in the reference ({:.1f} C after {:.1f} C), which "
      "changes friction in this way too: compare sessions of one temperature before it is called "
      "wear",
      std::abs(warmer), warmer > 0 ? "warmer" : "colder", after, before);
}

/// Findings of the best set.
class ChangeWriter {
 public:
  /// @param probable  least probability of a change, or of one in its place, that is reported
  ChangeWriter(const ChangeSystem& system, const ChangePosterior& posterior,
               const EffectRecordings& all, const std::vector<bool>& later, double probable)
      : system_(system),
        posterior_(posterior),
        all_(all),
        later_(later),
        probable_(probable),
        estimate_(system.estimate(posterior.best)) {}

  std::vector<Finding> run() {
    std::vector<Finding> findings;
    Index place = 0;
    for (std::size_t i = 0; i < posterior_.best.size(); ++i) {
      const ChangeForm& form = system_.forms()[posterior_.best[i]];
      const bool change = !system_.candidates()[form.candidate].both_sides;
      if (change && posterior_.probability_of_any(system_, form.candidate) >= probable_) {
        findings.push_back(finding(i, place));
      }
      place += form.mix.rows();
    }
    std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
      return a.evidence.lambda > b.evidence.lambda;
    });
    return findings;
  }

 private:
  Finding finding(std::size_t member, Index first) const {
    const ChangeForm& form = system_.forms()[posterior_.best[member]];
    const ChangeCandidate& own = system_.candidates()[form.candidate];
    Finding finding;
    finding.effect = own.effect;
    finding.since_reference = true;
    finding.formula = own.formula;
    finding.probability = posterior_.probability(system_, form.candidate);
    finding.uncertain = finding.probability < probable_;
    finding.where.share = kNotKnown;
    finding.aliases = own.families;
    std::vector<std::string> elsewhere;
    for (const std::size_t other : posterior_.replacements(system_, form.candidate)) {
      const ChangeCandidate& candidate = system_.candidates()[other];
      if (candidate.families.front() == own.families.front()) {
        elsewhere.push_back(fmt::format("the same of {}", place_of(candidate)));
        continue;
      }
      for (const std::string& family : candidate.families) {
        if (std::find(finding.aliases.begin(), finding.aliases.end(), family) ==
            finding.aliases.end()) {
          finding.aliases.push_back(family);
        }
      }
    }
    finding.elsewhere = fmt::format("{}", fmt::join(elsewhere, ", "));
    finding.parameters = parameters(own, form, first, finding.effect);
    if (own.kind == ChangeCandidate::Kind::kFriction) {
      keep_changed(finding);
      const double change = change_at_usual_speed(finding);
      const std::string caveat =
          warmth_caveat(mean_temperatures(all_, later_, own.effect.joint), change);
      if (!caveat.empty()) finding.caveats.push_back(caveat);
    }
    ChangeSet without = posterior_.best;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(member));
    finding.evidence.lambda =
        std::max(0.0, system_.chi_square(posterior_.best) - system_.chi_square(without) -
                          static_cast<double>(form.count));
    finding.evidence.delta_bic =
        -2 * (system_.log_evidence(posterior_.best) - system_.log_evidence(without));
    finding.why = why(own, form, first, finding);
    return finding;
  }

  std::vector<EffectParameterFit> parameters(const ChangeCandidate& own, const ChangeForm& form,
                                             Index first, EffectInstance& effect) const {
    std::vector<EffectParameterFit> fits(static_cast<std::size_t>(effect.law.size()));
    for (int p = 0; p < effect.law.size(); ++p) {
      fits[static_cast<std::size_t>(p)].value = effect.parameters[p];
      fits[static_cast<std::size_t>(p)].held = true;
    }
    for (std::size_t i = 0; i < own.parameters.size(); ++i) {
      EffectParameterFit& fit = fits[static_cast<std::size_t>(own.parameters[i])];
      const Index at = first + static_cast<Index>(i);
      fit.held = !form.point && form.mix.row(static_cast<Index>(i)).isZero(0);
      fit.seen = estimate_.seen[static_cast<std::size_t>(at)];
      fit.value = fit.seen ? estimate_.values[at] : kNotKnown;
      fit.stddev = fit.seen ? estimate_.deviations[at] : 0;
      effect.parameters[own.parameters[i]] = fit.value;
    }
    return fits;
  }

  /// Friction that did not change is no parameter of the change.
  static void keep_changed(Finding& finding) {
    for (std::size_t p = finding.parameters.size(); p-- > 0;) {
      if (!finding.parameters[p].held) continue;
      const auto at = static_cast<std::ptrdiff_t>(p);
      std::vector<EffectParameter>& names = finding.effect.law.parameters;
      finding.formula = names[p].name == "Fc" ? "Fv*qd" : "Fc*sign(qd)";
      names.erase(names.begin() + at);
      finding.parameters.erase(finding.parameters.begin() + at);
    }
    VectorXd& values = finding.effect.parameters;
    values.resize(static_cast<Index>(finding.parameters.size()));
    for (Index p = 0; p < values.size(); ++p) {
      values[p] = finding.parameters[static_cast<std::size_t>(p)].value;
    }
  }

  /// N m or N at the rms of the speed in the later sessions.
  [[nodiscard]] double change_at_usual_speed(const Finding& finding) const {
    double squares = 0, samples = 0, change = 0;
    for (std::size_t run = 0; run < all_.runs.size(); ++run) {
      if (!later_[run]) continue;
      squares += all_.runs[run].motion.dq.col(finding.effect.joint).squaredNorm();
      samples += static_cast<double>(all_.runs[run].motion.samples());
    }
    const double speed = std::sqrt(squares / std::max(samples, 1.0));
    for (std::size_t p = 0; p < finding.parameters.size(); ++p) {
      const bool viscous = finding.effect.law.parameters[p].name == "Fv";
      change += finding.parameters[p].value * (viscous ? speed : 1.0);
    }
    return change;
  }

  static std::string place_of(const ChangeCandidate& own) {
    if (own.kind == ChangeCandidate::Kind::kLoad) {
      return own.effect.joint < 0 ? "the last link"
                                  : fmt::format("the link of joint {}", own.effect.joint + 1);
    }
    return own.effect.joint < 0 ? "the whole robot" : fmt::format("joint {}", own.effect.joint + 1);
  }

  /// "friction_change of joint 2 since the reference: Fc 8.1 -> 6.2 N m (-23 %)".
  std::string why(const ChangeCandidate& own, const ChangeForm& form, Index first,
                  const Finding& finding) const {
    std::vector<std::string> numbers, hidden;
    for (std::size_t i = 0; i < own.parameters.size(); ++i) {
      const EffectParameter& law =
          own.effect.law.parameters[static_cast<std::size_t>(own.parameters[i])];
      const Index at = first + static_cast<Index>(i);
      if (!estimate_.seen[static_cast<std::size_t>(at)]) hidden.push_back(law.name);
      const bool changes = form.point || !form.mix.row(static_cast<Index>(i)).isZero(0);
      if (own.base[i] < 0 || !changes) continue;
      const double before = estimate_.reference[own.base[i]], by = estimate_.values[at];
      numbers.push_back(fmt::format("{} {:.4g} -> {:.4g} {} ({:+.0f} %)", law.name, before,
                                    before + by, law.unit, 100 * by / std::abs(before)));
    }
    std::string text =
        fmt::format("{} of {} since the reference", own.families.front(), place_of(own));
    if (own.kind == ChangeCandidate::Kind::kLoad) {
      const Index mass = first + kBodyParameters - 1;
      const bool seen = estimate_.seen[static_cast<std::size_t>(mass)];
      if (seen) text += estimate_.values[mass] < 0 ? ": a body was taken off" : ": a body came";
    }
    if (!numbers.empty()) text += ": " + fmt::format("{}", fmt::join(numbers, ", "));
    text += fmt::format("; it lowers chi-square by {:.0f}", finding.evidence.lambda);
    if (!hidden.empty()) {
      text += fmt::format("; no motion of these recordings shows {}", fmt::join(hidden, ", "));
    }
    if (!finding.elsewhere.empty()) {
      text += "; these data cannot separate it from " + finding.elsewhere;
    }
    for (const std::string& caveat : finding.caveats) text += "; " + caveat;
    return text;
  }

  const ChangeSystem& system_;
  const ChangePosterior& posterior_;
  const EffectRecordings& all_;
  const std::vector<bool>& later_;
  double probable_;
  ChangeEstimate estimate_;
};

/// The sessions of both sides, and what is known to act in all of them.
class ChangeSearch {
 public:
  ChangeSearch(const ComparedSessions& compared, const DiagnosisInput& input,
               const CompetitionResult& result, double false_alarm, const DecisionRules& rules)
      : input_(input),
        false_alarm_(false_alarm),
        rules_(rules),
        all_(together(compared.reference, compared.later)),
        plan_(plan_of(compared)),
        point_(result.fit.point) {
    for (const int session : plan_.of_run) later_.push_back(session >= plan_.reference);
    point_.initial.clear();
    blocks_ = without_effects(all_, point_);
    noise_ = result.noise;
  }

  /// @param effects  linear ones that may have come, or act on both sides
  ChangesSince run(std::vector<Hypothesis> effects) {
    effects_ = std::move(effects);
    for (;;) {
      const std::size_t before = effects_.size();
      ChangesSince answer = look();
      if (effects_.size() == before) return answer;
    }
  }

 private:
  /// Effects of the best set that act on both sides become parameters of both, so that the scatter
  /// between sessions is what is left beside them.
  ChangesSince look() {
    const Index nb = all_.model.size();
    const ChangeCandidates candidates = change_candidates(all_, later_, input_, effects_, point_);
    // what effects leave of both sides, each session fitted by itself: noise, and misfit
    const RunResiduals left = residuals_of_sessions(blocks_, plan_, noise_.joints, nb,
                                                    candidates.further, candidates.shared);
    noise_ = torque_noise_model(all_, left, std::vector<double>(all_.runs.size(), 0.0), true);
    const std::vector<SessionEquations> sessions =
        session_equations(blocks_, plan_, noise_.joints, candidates.further);
    const Index common = nb + candidates.shared;
    const MatrixXd estimates = estimates_of_sessions(sessions, nb);
    const VectorXd size = estimates.leftCols(plan_.reference).rowwise().mean().cwiseAbs();
    const SessionScatter scatter = session_scatter(
        sessions, scatter_terms(all_.model, size, torque_rms(blocks_), rules_.changes), common,
        rules_.changes);
    ChangesSince answer;
    answer.sessions = sentence_of(scatter, plan_, all_.model.revolute);
    ChangeSystem system(sessions, scatter, common, candidates.all, false_alarm_, rules_.changes);
    ChangePosterior posterior = change_posterior(system);
    if (posterior.best.empty() || share_effects_of_both(system, posterior)) return answer;
    // loads that are points, at their places beside the other changes
    system.place_points(posterior.best);
    posterior = change_posterior(system);
    if (posterior.best.empty() || share_effects_of_both(system, posterior)) return answer;
    answer.findings = ChangeWriter(system, posterior, all_, later_, rules_.answer.probable).run();
    return answer;
  }

  /// @return whether there were any
  bool share_effects_of_both(const ChangeSystem& system, const ChangePosterior& posterior) {
    bool any = false;
    for (const std::size_t member : posterior.best) {
      const ChangeCandidate& own = system.candidates()[system.forms()[member].candidate];
      if (!own.both_sides) continue;
      any = true;
      point_.effects.push_back(own.effect);
      std::erase_if(effects_, [&](const Hypothesis& effect) {
        return is_same_effect(effect.effect, own.effect);
      });
    }
    return any;
  }

  const DiagnosisInput& input_;
  double false_alarm_;
  const DecisionRules& rules_;
  EffectRecordings all_;
  SessionPlan plan_;
  EffectPoint point_;  ///< with effects of both sides
  std::vector<bool> later_;
  std::vector<RowBlock> blocks_;
  TorqueNoiseModel noise_;
  std::vector<Hypothesis> effects_;
};

}  // namespace

ChangesSince changes_since(const ComparedSessions& compared, const DiagnosisInput& input,
                           const std::vector<Hypothesis>& hypotheses,
                           const CompetitionResult& result, double false_alarm,
                           const DecisionRules& rules) {
  ChangeSearch search(compared, input, result, false_alarm, rules);
  return search.run(possible(hypotheses, result, !input.loads.empty()));
}

VectorXd fitted_to_reference(const EffectRecordings& reference, const VectorXd& start) {
  std::vector<RowBlock> blocks;
  SessionPlan plan;
  plan.reference = 1;
  for (const EffectRun& run : reference.runs) {
    RowBlock block = run.rows;
    block.tau = residual(run.rows, start);
    blocks.push_back(std::move(block));
    plan.of_run.push_back(0);
  }
  const VectorXd rms = torque_rms(blocks);
  std::vector<AutoregressiveNoise> white(static_cast<std::size_t>(rms.size()));
  for (std::size_t j = 0; j < white.size(); ++j) {
    white[j].innovation = white[j].deviation = std::max(rms[static_cast<Index>(j)], 1e-300);
  }
  const auto sessions = session_equations(blocks, plan, quick_noise(white), {});
  return start + estimates_of_sessions(sessions, start.size()).col(0);
}

}  // namespace dyngen::runtime
