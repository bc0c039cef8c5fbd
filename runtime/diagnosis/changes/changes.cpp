// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/changes/changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "runtime/diagnosis/changes/change_findings.h"
#include "runtime/effects/effect_residual.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTheorem = 1e-6;  // part of an effect's chi-square that the model leaves

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
    answer.findings = change_findings(system, posterior, all_, later_, rules_.answer.probable);
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
