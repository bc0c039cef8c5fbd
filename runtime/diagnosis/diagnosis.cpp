// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "runtime/diagnosis/answer/certificate.h"
#include "runtime/diagnosis/answer/condition_lines.h"
#include "runtime/diagnosis/answer/found_effects.h"
#include "runtime/diagnosis/answer/heldout_remarks.h"
#include "runtime/diagnosis/answer/heldout_verdict.h"
#include "runtime/diagnosis/answer/unnamed_text.h"
#include "runtime/diagnosis/answer/verdict.h"
#include "runtime/diagnosis/changes/changes.h"
#include "runtime/diagnosis/competition/heldout.h"
#include "runtime/diagnosis/competition/loop_disturbance.h"
#include "runtime/diagnosis/competition/search.h"
#include "runtime/diagnosis/equation_sets/raw_residual.h"
#include "runtime/diagnosis/equation_sets/sufficiency.h"
#include "runtime/diagnosis/names/next_experiment.h"
#include "runtime/diagnosis/names/noise_sentence.h"
#include "runtime/diagnosis/names/undecidable.h"
#include "runtime/diagnosis/scans/in_parallel.h"
#include "runtime/identification/standing_joints.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// A point whose states begin as their laws say.
EffectPoint from_rest(EffectPoint point) {
  point.initial.clear();
  return point;
}

/// Where no motion repeats the residual is noise and structure that was found without a name: less
/// that, as far as the equations' own noise goes. @param floor (n) N m or N
VectorXd without_nameless(const VectorXd& floor, const CompetitionResult& result) {
  if (result.noise.from_periods) return floor;
  VectorXd squares = floor.cwiseAbs2();
  for (const Nameless& nameless : result.nameless) {
    squares[nameless.structure.joint] -= nameless.rms * nameless.rms;
  }
  for (Index j = 0; j < squares.size(); ++j) {
    const double least = result.noise.joints[static_cast<std::size_t>(j)].deviation();
    squares[j] = std::max(squares[j], std::min(least * least, floor[j] * floor[j]));
  }
  return squares.cwiseSqrt();
}

/// One diagnosis while it is made.
class Diagnostician {
 public:
  Diagnostician(const DiagnosisInput& input, const DiagnosisOptions& options,
                const DiagnosisProgress& progress, const DiagnosisObserver& observer)
      : input_(input),
        options_(options),
        progress_(progress),
        observer_(observer),
        search_(input, options.decimation, options.rules.equations) {}

  Diagnosis run() {
    answer_.condition = condition_lines(input_, search_.parts(), &search_.shown_train());
    answer_.not_judged = search_.unjudged();
    answer_.sentence = why_too_few(answer_.not_judged, input_.model.joints());
    if (!answer_.sentence.empty()) return std::move(answer_);
    const std::string too_little = why_not_clean();
    CompetitionOptions settings;
    settings.false_alarm = options_.false_alarm;
    settings.most_winners = options_.most_findings;
    settings.effort = options_.effort;
    settings.seed = options_.seed;
    settings.with_regressor = !options_.residual_only;
    settings.rules = options_.rules;
    search_.compete(settings, progress_);
    answer_.effort = effort_used();
    describe_noise();
    answer_.before = tests_of(result().first);
    answer_.after = tests_of(result().last);
    if (found_nothing(result())) {
      // what was not searched may be all that makes the residual slow
      answer_.sentence = too_little;
      if (answer_.sentence.empty()) answer_.sentence = why_cut_off(result());
      if (answer_.sentence.empty()) {
        answer_.sentence = why_too_slow(result(), options_.rules.noise);
      }
    }
    if (!answer_.sentence.empty()) return std::move(answer_);
    answer_.findings = found_effects(search_, settings, progress_);
    answer_.effort = effort_used();
    answer_.fit = result().fit;
    before_ = from_rest(result().base.point);
    describe_changes();
    answer_.unexplained = described(result().nameless);
    answer_.undecidable = undecidable_effects(search_.hypotheses(), result().first, input_.model);
    answer_.detectable_lambda = detectable_lambda(result().last.threshold(options_.false_alarm));
    answer_.certificate = certificate_of(search_.hypotheses(), result(), answer_.detectable_lambda);
    describe_base();
    describe_heldout();
    answer_.next = next_experiment(answer_.findings);
    Conclusion conclusion = concluded(search_, answer_.findings, options_.rules.answer);
    if (conclusion.verdict == Verdict::kClean || conclusion.verdict == Verdict::kExplained) {
      const auto other = contradicted(judged_, known_, answer_.findings.empty(),
                                      input_.model.revolute, options_.rules.answer);
      if (other) conclusion = *other;
    }
    answer_.verdict = conclusion.verdict;
    answer_.sentence = conclusion.sentence;
    const std::string beside = not_judged_sentence(answer_.not_judged);
    if (!beside.empty()) answer_.sentence += " " + beside;
    blank_masked();
    show();
    return std::move(answer_);
  }

 private:
  [[nodiscard]] EffortUsed effort_used() const {
    return {options_.effort, search_.work(), result().cut_off, search_.not_offered()};
  }

  /// Why recordings in which nothing is found would not be clean; empty: they are.
  [[nodiscard]] std::string why_not_clean() const {
    if (options_.residual_only) return {};
    return why_too_little_motion(search_.sets().train, search_.sets().proof,
                                 options_.rules.equations);
  }

  void tell(const std::string& stage, double done) const {
    if (progress_) progress_(stage, done);
  }

  [[nodiscard]] const CompetitionResult& result() const { return search_.result(); }

  void describe_noise() {
    const TorqueNoiseModel& noise = result().noise;
    answer_.noise.correlation_time = noise.correlation_time;
    answer_.noise.worth = noise.worth;
    answer_.noise.from_periods = noise.from_periods;
    answer_.noise.how = noise_sentence(noise, search_.parts().train, search_.seen().sticking,
                                       result().sticking, disturbed_joints());
  }

  /// Joints, from 0, on which a disturbance inside the loop is seen beside all that was found.
  [[nodiscard]] std::vector<int> disturbed_joints() const {
    if (result().noise.from_periods || options_.residual_only) return {};
    const EffectRecordings& evidence = search_.sets().evidence();
    EffectSignals signals(evidence);
    EvidenceSystem::Options settings;
    settings.surrogates = 0;
    settings.rules = options_.rules;
    const EvidenceSystem system = system_beside(evidence, signals, search_.hypotheses(), result(),
                                                result().fit.point, result().noise, settings);
    return LoopDisturbance(evidence, result().noise, options_.false_alarm).joints_beside(system);
  }

  std::vector<StructureTest> tests_of(const Screening& screening) const {
    const std::vector<GenericStructure> structures = structures_of(search_.sets().train);
    std::vector<StructureTest> tests;
    const double threshold = screening.threshold(options_.false_alarm);
    for (int j = 0; j < search_.sets().train.joints(); ++j) {
      if (search_.sets().train.is_masked(j)) continue;
      StructureTest test{j, 0, threshold, ""};
      for (const GenericResult& generic : screening.generic) {
        const GenericStructure& structure = structures[generic.structure];
        if (structure.joint != j || generic.surprise <= test.statistic) continue;
        test.statistic = generic.surprise;
        test.variable = fmt::format("{}", fmt::join(structure.names(), ", "));
      }
      tests.push_back(test);
    }
    return tests;
  }

  void describe_changes() {
    if (input_.reference.empty()) return;
    tell("changes since the reference", 0);
    const EffectRecordings reference = equations_of(input_, input_.reference, search_.seen());
    // both sides alike: columns of a motion's own samples
    const EffectRecordings later = equations_of(input_, search_.parts().train, search_.seen());
    ComparedSessions compared{reference, later, {}};
    for (std::size_t i = 0; i < search_.parts().train.size(); ++i) {
      compared.later_files.push_back(static_cast<int>(search_.parts().origin_of(i)));
    }
    ChangesSince changes = changes_since(compared, input_, search_.hypotheses(), result(),
                                         options_.false_alarm, options_.rules);
    answer_.sessions = std::move(changes.sessions);
    for (Finding& change : changes.findings) answer_.findings.push_back(std::move(change));
    before_.beta = fitted_to_reference(reference, before_.beta);
  }

  void describe_base() {
    const VectorXd& before = before_.beta;
    const VectorXd deviation = answer_.fit.base.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    for (Index i = 0; i < before.size(); ++i) {
      const bool seen = !is_unseen(answer_.fit.base, static_cast<int>(i));
      answer_.base_parameters.push_back({input_.model.parameters[static_cast<std::size_t>(i)].name,
                                         before[i], answer_.fit.point.beta[i],
                                         seen ? deviation[i] : kNoNumber});
    }
  }

  void describe_heldout() {
    tell("held-out recordings", 0);
    const EffectRecordings &train = search_.shown_train(), &heldout = search_.shown_heldout();
    const EffectPoint after = from_rest(answer_.fit.point);
    const RunResiduals without = raw_residuals(heldout, before_),
                       with = raw_residuals(heldout, after);
    answer_.heldout.before = raw_rms(heldout, without);
    answer_.heldout.after = raw_rms(heldout, with);
    describe_gains();
    answer_.noise.deviation = without_nameless(
        raw_floor(train, raw_residuals(train, after), repeats_of(train)), result());
    answer_.heldout.floor = answer_.noise.deviation;
    const Eigen::ArrayXd judged = counted_part(search_.sets().proof).array();
    const Eigen::ArrayXd all = counted_part(search_.sets().heldout).array();
    answer_.heldout.visited = (all > 0).select(judged / all.max(1e-300), 0.0).matrix();
    judge_heldout(without, with, after);
    answer_.heldout.remarks = heldout_remarks(answer_.heldout, judged_, options_.rules.answer);
  }

  /// The same away from reversals, where friction can take any value.
  /// @param without, with  the findings: residuals of the held-out recordings
  void judge_heldout(const RunResiduals& without, const RunResiduals& with,
                     const EffectPoint& after) {
    const auto [train, heldout, proof] = search_.judged();
    known_.masked = search_.sets().train.masked;
    judged_ = answer_.heldout;
    judged_.before = raw_rms(heldout, without);
    judged_.after = raw_rms(heldout, with);
    judged_.floor = without_nameless(
        raw_floor(train, raw_residuals(train, after), repeats_of(train)), result());
    known_.with_reversals = search_.seen().sticking.empty();
    const HeldoutResidual& compared = known_.with_reversals ? answer_.heldout : judged_;
    known_.without = compared.before;
    known_.with = compared.after;
    known_.worse =
        worsening(known_.with_reversals ? search_.shown_heldout() : heldout, without, with);
    const VectorXd equations = counted_equations(proof),
                   fitted = counted_equations(search_.sets().train);
    known_.equations = whitened_squares(proof, residuals_of(proof, after), result().noise)
                           .cwiseQuotient(equations.cwiseMax(1.0));
    known_.predicted = options_.residual_only
                           ? VectorXd::Zero(input_.model.joints())
                           : predicted_variance(search_.sets().train, search_.sets().proof);
    known_.fitted_worth = result().noise.worth;
    known_.heldout_worth =
        known_.fitted_worth.cwiseProduct(equations).cwiseQuotient(fitted.cwiseMax(1.0));
  }

  /// What each finding lowers of the held-out torque of its joints, beside all others.
  void describe_gains() {
    const EffectRecordings& heldout = search_.shown_heldout();
    const auto& effects = answer_.fit.point.effects;
    const std::size_t count = std::min(effects.size(), answer_.findings.size());
    const VectorXd alone = raw_rms(heldout, raw_residuals(heldout, from_rest(result().base.point)));
    std::vector<VectorXd> without_one(count, alone);
    const auto fit_others = [&](std::size_t i, std::size_t) {
      std::vector<EffectInstance> others = effects;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      const EffectFit fit = fit_effects(search_.sets().train, others, comparison_fit());
      without_one[i] = raw_rms(heldout, raw_residuals(heldout, from_rest(fit.point)));
    };
    if (effects.size() > 1) {
      in_parallel(count, working_threads(), fit_others,
                  [&](double done) { tell("held-out recordings", done); });
    }
    for (std::size_t i = 0; i < count; ++i) {
      const VectorXd& without = without_one[i];
      double all = 0, left = 0;
      for (const int joint : joints_of(effects[i], input_.model.joints())) {
        if (search_.sets().train.is_masked(joint)) continue;
        const double floor = std::max(answer_.heldout.after[joint], 1e-300);
        all += std::pow(without[joint] / floor, 2);
        left += 1;
      }
      answer_.findings[i].evidence.heldout_gain = all > 0 ? 1 - std::sqrt(left / all) : 0;
    }
  }

  /// Nothing is known of joints that are not judged.
  void blank_masked() {
    for (const UnjudgedJoint& own : answer_.not_judged) {
      HeldoutResidual& rms = answer_.heldout;
      for (VectorXd* values : {&rms.before, &rms.after, &rms.floor, &answer_.noise.deviation,
                               &answer_.noise.correlation_time, &answer_.noise.worth}) {
        if (own.joint < values->size()) (*values)[own.joint] = kNoNumber;
      }
    }
  }

  /// (n) equations that count
  static VectorXd counted_equations(const EffectRecordings& data) {
    VectorXd counts = VectorXd::Zero(data.joints());
    for (const EffectRun& run : data.runs) {
      counts += run.rows.counted.colwise().sum().transpose();
    }
    return counts;
  }

  void show() const {
    if (!observer_) return;
    tell("the report", 0);
    DiagnosedRecordings shown{answer_, search_.shown_train(),        search_.shown_heldout(),
                              before_, from_rest(answer_.fit.point), {}};
    for (const MotionSource& source : search_.parts().heldout) {
      shown.heldout_names.push_back(source.name);
    }
    observer_(shown);
  }

  const DiagnosisInput& input_;
  const DiagnosisOptions& options_;
  const DiagnosisProgress& progress_;
  const DiagnosisObserver& observer_;
  Search search_;
  Diagnosis answer_;
  EffectPoint before_;      ///< the model alone; of the reference, where there is one
  HeldoutResidual judged_;  ///< away from reversals
  HeldoutKnowledge known_;  ///< the same
};

}  // namespace

void DiagnosisOptions::validate() const {
  if (!(false_alarm > 0 && false_alarm < 0.5)) {
    throw std::invalid_argument(fmt::format(
        "DiagnosisOptions: false_alarm is {}, expected a number in (0, 0.5)", false_alarm));
  }
  if (!(effort >= 0 && std::isfinite(effort))) {
    throw std::invalid_argument(
        fmt::format("DiagnosisOptions: effort is {}, expected a number, 0 or more", effort));
  }
  if (most_findings < 0) {
    throw std::invalid_argument(
        fmt::format("DiagnosisOptions: most_findings is {}, expected 0 or more", most_findings));
  }
}

Diagnosis diagnose(const DiagnosisInput& given, const DiagnosisOptions& options,
                   const DiagnosisProgress& progress, const DiagnosisObserver& observer) {
  options.validate();
  DiagnosisInput input = given;
  hold_standing_joints(input.model.revolute, input.train, {&input.heldout, &input.reference});
  try {
    return Diagnostician(input, options, progress, observer).run();
  } catch (const TooLittleDataError& error) {
    Diagnosis answer;
    answer.condition = condition_lines(input, {}, nullptr);
    answer.sentence = error.what();
    return answer;
  }
}

}  // namespace dyngen::runtime
