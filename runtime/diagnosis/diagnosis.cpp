// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>

#include "runtime/diagnosis/competition.h"
#include "runtime/diagnosis/division.h"
#include "runtime/diagnosis/heldout.h"
#include "runtime/diagnosis/name_tests.h"
#include "runtime/diagnosis/naming.h"
#include "runtime/diagnosis/next_experiment.h"
#include "runtime/diagnosis/noise_sentence.h"
#include "runtime/diagnosis/raw_residual.h"
#include "runtime/diagnosis/reference.h"
#include "runtime/diagnosis/sufficiency.h"
#include "runtime/diagnosis/undecidable.h"
#include "runtime/diagnosis/views.h"
#include "runtime/diagnosis/whereabouts.h"
#include "runtime/effects/absorption.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kLeastIndependent = 25;  // samples of a joint, after its noise's correlation
constexpr double kLeastCounted = 0.35;    // of a joint's equations, beside its rests
constexpr double kObjection =
    0.5;                         // the most of a name against which a bound or a falsifier speaks
constexpr double kStable = 0.8;  // of halves of the recordings: Meinshausen and Buehlmann 2010
constexpr double kUnexplainedPart = 0.2;  // of a joint's structure: above it a verdict is open

std::vector<ConditionLine> conditions_of(const DiagnosisInput& input) {
  std::vector<ConditionLine> lines;
  for (const MotionSource& source : input.train) {
    lines.push_back({source.name, source.condition.messages});
  }
  return lines;
}

std::string where_it_acts(const EffectInstance& effect) {
  if (effect.joint < 0) return "the whole robot";
  if (effect.other >= 0) {
    return fmt::format("joints {} and {}", effect.joint + 1, effect.other + 1);
  }
  return fmt::format("joint {}", effect.joint + 1);
}

/// Whether the name holds on halves of the recordings.
FalsifierOutcome stability_test(const Naming& naming) {
  const double share = naming.stability();
  return {"stability", share >= kStable,
          fmt::format("{} explains most of {:.0f} of 100 halves of the recordings",
                      naming.families.size() > 1 ? "it, or a name that is not told apart," : "it",
                      100 * share),
          true};
}

std::string when_it_acts(const Whereabouts& where) {
  return where.recording.empty() ? "" : " in " + where.recording;
}

/// One diagnosis while it is made.
class Diagnostician {
 public:
  Diagnostician(const DiagnosisInput& input, const DiagnosisOptions& options,
                const DiagnosisProgress& progress, const DiagnosisWitness& witness)
      : input_(input),
        options_(options),
        progress_(progress),
        witness_(witness),
        parts_(input.heldout.empty() ? divided(input.train) : Division{input.train, input.heldout}),
        seen_{diagnosis_rows(parts_.train, options.decimation), {}},
        views_(views_of(input, parts_, seen_)) {}

  Diagnosis run() {
    answer_.condition = conditions_of(input_);
    if (!enough()) return std::move(answer_);
    CompetitionOptions settings;
    settings.false_alarm = options_.false_alarm;
    settings.most_winners = options_.most_findings;
    settings.seed = options_.seed;
    settings.with_regressor = !options_.residual_only;
    const ScaleTable scales(views_.train);
    const VectorXd alone = model_alone();
    for (const EffectInstance& effect : input_.hypotheses) {
      hypotheses_.push_back(hypothesis_of(effect, scales.of(alone, effect)));
    }
    compete(settings);
    describe_noise();
    describe_tests();
    if (!worth_enough()) return std::move(answer_);
    describe_findings();
    describe_changes();
    describe_unexplained();
    answer_.undecidable = undecidable_effects(hypotheses_, result_.first, input_.model);
    describe_certificate();
    describe_base();
    describe_heldout();
    answer_.next = next_experiment(answer_.findings);
    conclude();
    show();
    return std::move(answer_);
  }

 private:
  void tell(const std::string& stage, double done) const {
    if (progress_) progress_(stage, done);
  }

  /// Parameters of the model without effects: typical sizes are parts of its friction.
  [[nodiscard]] VectorXd model_alone() const {
    EffectFitOptions once;
    once.most_rounds = 1;
    return fit_effects(views_.train, {}, once).point.beta;
  }

  /// As soon as joints are found to rest, everything is looked at again beside their rests.
  void compete(CompetitionOptions settings) {
    settings.until_rest = true;
    for (;;) {
      Witness slow(views_.slow);
      result_ = runtime::compete(views_.evidence(), views_.train, slow, views_.proof, hypotheses_,
                                 settings, progress_);
      if (!settings.until_rest || result_.resting.empty()) return;
      // where that would leave too little, impulses at their reversals are left out instead
      settings.until_rest = look_beside(result_.resting);
      settings.rests = true;
    }
  }

  /// @return whether equations are left out that had not been before
  bool look_beside(const std::vector<RestingJoint>& found) {
    std::vector<RestingJoint> joints = seen_.resting;
    if (!join(joints, found)) return false;
    const ViewOptions beside =
        beside_rests({diagnosis_rows(parts_.train, options_.decimation), {}}, parts_.train, joints);
    Views views = views_of(input_, parts_, beside);
    if (least_counted(views.train) < kLeastCounted) return false;
    if (!whole_) whole_ = Whole{std::move(views_.train), std::move(views_.heldout)};
    seen_ = beside;
    views_ = std::move(views);
    return true;
  }

  /// Whether there are samples enough to test anything.
  bool enough() {
    answer_.sentence = why_insufficient(views_.train, views_.heldout, !options_.residual_only);
    return answer_.sentence.empty();
  }

  /// Whether slow noise leaves independent samples enough to call recordings clean.
  bool worth_enough() {
    if (!result_.winners.empty() || !result_.nameless.empty()) return true;
    Index joint = 0;
    const double least = result_.noise.worth.minCoeff(&joint);
    if (least >= kLeastIndependent) return true;
    answer_.verdict = Verdict::kInsufficientData;
    answer_.sentence = fmt::format(
        "What the model leaves of joint {} is so slow that the recordings are worth {:.0f} "
        "independent samples: too few to tell structure from noise.",
        joint + 1, least);
    return false;
  }

  void describe_noise() {
    const TorqueNoiseModel& noise = result_.noise;
    answer_.noise.correlation_time = noise.correlation_time;
    answer_.noise.worth = noise.worth;
    answer_.noise.from_periods = noise.from_periods;
    answer_.noise.how = noise_sentence(noise, parts_.train, seen_.resting, result_.resting);
  }

  void describe_tests() {
    answer_.before = tests_of(result_.first);
    answer_.after = tests_of(result_.last);
  }

  std::vector<StructureTest> tests_of(const Screening& screening) const {
    const std::vector<GenericStructure> structures = generic_structures(views_.train.joints());
    std::vector<StructureTest> tests;
    const double threshold =
        -std::log(-std::expm1(std::log1p(-options_.false_alarm) / screening.tests));
    for (int j = 0; j < views_.train.joints(); ++j) {
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

  void describe_findings() {
    answer_.fit = result_.fit;
    if (result_.winners.empty()) return;
    tell("the final fit", 0);
    std::vector<EffectInstance> effects = result_.fit.point.effects;
    answer_.fit = fit_effects(views_.train, effects);
    result_.fit = answer_.fit;
    EffectSignals signals(views_.evidence());
    EvidenceSystem::Options system;
    system.seed = options_.seed;
    system.surrogates = 0;
    system.with_regressor = !options_.residual_only;
    const std::vector<Naming> namings =
        settle_names(views_.evidence(), views_.train, views_.proof, signals, hypotheses_, result_,
                     system, progress_);
    answer_.fit = result_.fit;
    for (std::size_t i = 0; i < namings.size(); ++i) {
      answer_.findings.push_back(finding(i, namings[i], signals, system));
    }
  }

  Finding finding(std::size_t place, const Naming& naming, EffectSignals& signals,
                  const EvidenceSystem::Options& options) {
    const Winner& winner = result_.winners[place];
    const Hypothesis& hypothesis = hypotheses_[winner.hypothesis];
    Finding finding;
    finding.effect = answer_.fit.point.effects[place];
    finding.parameters = answer_.fit.parameters[place];
    finding.aliases = naming.families;
    finding.probability = naming.probability;
    finding.absorbed = 1 - naming.part_left;
    finding.evidence = {naming.lambda, naming.delta_bic, 0};
    const EvidenceSystem system =
        system_without(views_.evidence(), signals, hypotheses_, result_, place, options);
    finding.tests = name_tests(views_.evidence(), signals, system, finding.effect);
    if (!hypothesis.windowed) finding.tests.push_back(stability_test(naming));
    finding.where = whereabouts_of(views_.evidence(), signals, system, hypothesis, finding.effect);
    if (finding.effect.recording >= 0) {
      finding.where.recording =
          parts_.train[static_cast<std::size_t>(finding.effect.recording)].name;
    }
    finding.evidence.heldout_gain =
        1 - std::sqrt(winner.heldout_after / std::max(winner.heldout_before, 1e-300));
    for (const EffectRemark& remark : answer_.fit.remarks) {
      if (!answer_.fit.objects(remark, static_cast<int>(place))) continue;
      finding.probability = std::min(finding.probability, kObjection);
      finding.doubted = true;
      finding.tests.push_back(
          {remark.kind == EffectRemark::Kind::kFalsified ? "falsifier" : "bound", false,
           remark.text, true});
    }
    finding.why = why(finding, naming);
    return finding;
  }

  std::string why(const Finding& finding, const Naming& naming) const {
    std::string text = fmt::format(
        "{} on {} explains {:.0f} squares of noise that the model cannot",
        finding.effect.law.family, where_it_acts(finding.effect) + when_it_acts(finding.where),
        finding.evidence.lambda);
    if (naming.unnamed_distance < kApart) {
      text += fmt::format("; {}, which is no effect of the catalogue, is {:.0f} squares {}",
                          naming.unnamed, std::abs(naming.unnamed_distance),
                          naming.unnamed_distance < 0 ? "better" : "worse");
    } else if (naming.rivals.empty()) {
      text += "; nothing else comes near";
    }
    if (naming.rivals.empty()) return text;
    const Rival& next = naming.rivals.front();
    if (finding.aliases.size() > 1) {
      return text + fmt::format("; these data do not tell it from {}", next.name);
    }
    return text +
           fmt::format("; the next name, {}, is {:.0f} squares worse", next.name, next.distance);
  }

  void describe_changes() {
    if (input_.reference.empty()) return;
    tell("changes since the reference", 0);
    const EffectRecordings reference = equations_of(input_, input_.reference, seen_);
    for (Finding& change :
         changes_since(reference, views_.train, hypotheses_, result_, options_.false_alarm)) {
      answer_.findings.push_back(std::move(change));
    }
  }

  void describe_unexplained() {
    for (const Nameless& nameless : result_.nameless) {
      Unexplained unexplained;
      unexplained.joint = nameless.structure.joint;
      unexplained.variables = nameless.names();
      unexplained.rms = nameless.rms;
      unexplained.description = fmt::format(
          "torque of joint {} that goes with {}, rms {:.3g}, {}", unexplained.joint + 1,
          fmt::join(unexplained.variables, " and "), unexplained.rms, shape_of(nameless));
      answer_.unexplained.push_back(std::move(unexplained));
    }
  }

  [[nodiscard]] static std::string shape_of(const Nameless& nameless) {
    if (!nameless.costly.empty()) {
      return fmt::format(
          "more than noise; {} would explain it, with more parameters than these data pay for",
          nameless.costly);
    }
    if (nameless.ruled_out) {
      std::string numbers;
      const EffectInstance& effect = *nameless.ruled_out;
      for (int p = 0; p < effect.law.size(); ++p) {
        numbers += fmt::format("{}{} {:.3g}", numbers.empty() ? "" : ", ",
                               effect.law.parameters[static_cast<std::size_t>(p)].name,
                               effect.parameters[p]);
      }
      return fmt::format("of the form of {} ({}), which cannot be its name: {}", short_name(effect),
                         numbers, nameless.objection);
    }
    const GenericStructure& structure = nameless.structure;
    if (structure.form == GenericStructure::Form::kLine) {
      return fmt::format("most of it a sinusoid of {:.3g} Hz, with a phase of its own in each run",
                         structure.frequency[0]);
    }
    if (structure.form == GenericStructure::Form::kRepeats) {
      return fmt::format(
          "below {:.3g} Hz, which comes back in every period of the motion and is no function of "
          "one or two of its variables that was tried",
          structure.frequency[0]);
    }
    if (structure.form == GenericStructure::Form::kWave) {
      const std::vector<std::string> names = structure.names();
      return fmt::format("most of it a sinusoid of about {:.2g} {} {} {:.2g} {}",
                         structure.frequency[0], names[0], structure.frequency[1] < 0 ? "-" : "+",
                         std::abs(structure.frequency[1]), names[1]);
    }
    if (structure.form == GenericStructure::Form::kSpeeds) {
      return "a function of the product of velocities that no effect of the catalogue is";
    }
    return "in a shape that no effect of the catalogue has";
  }

  void describe_certificate() {
    std::set<std::size_t> found;
    for (const Winner& winner : result_.winners) found.insert(winner.hypothesis);
    for (const NamedResult& named : result_.last.named) {
      if (found.contains(named.hypothesis) || named.typical.size() == 0) continue;
      const Hypothesis& hypothesis = hypotheses_[named.hypothesis];
      Index main = 0;
      named.typical.cwiseAbs().maxCoeff(&main);
      CertificateLine line;
      line.effect = hypothesis.effect;
      line.parameter = hypothesis.linear[static_cast<std::size_t>(main)];
      line.smallest =
          named.typical_lambda > 0 && named.part_left > 1e-6
              ? std::abs(named.typical[main]) * std::sqrt(kDetectableLambda / named.typical_lambda)
              : std::numeric_limits<double>::infinity();
      answer_.certificate.push_back(std::move(line));
    }
  }

  void describe_base() {
    const VectorXd& before = result_.base.point.beta;
    const VectorXd deviation = answer_.fit.base.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    for (Index i = 0; i < before.size(); ++i) {
      answer_.base_parameters.push_back({input_.model.parameters[static_cast<std::size_t>(i)].name,
                                         before[i], answer_.fit.point.beta[i], deviation[i]});
    }
  }

  void describe_heldout() {
    tell("held-out recordings", 0);
    EffectPoint before = result_.base.point, after = answer_.fit.point;
    before.initial.clear();
    after.initial.clear();
    const EffectRecordings &train = shown_train(), &heldout = shown_heldout();
    answer_.heldout.before = raw_rms(heldout, raw_residuals(heldout, before));
    answer_.heldout.after = raw_rms(heldout, raw_residuals(heldout, after));
    EffectPoint fitted = answer_.fit.point;
    fitted.initial.clear();
    answer_.noise.deviation = raw_floor(train, raw_residuals(train, fitted), repeats_of(train));
    answer_.heldout.floor = answer_.noise.deviation;
  }

  /// Recordings that an rms is of.
  [[nodiscard]] const EffectRecordings& shown_train() const {
    return whole_ ? whole_->train : views_.train;
  }
  [[nodiscard]] const EffectRecordings& shown_heldout() const {
    return whole_ ? whole_->heldout : views_.heldout;
  }

  void show() const {
    if (!witness_) return;
    tell("the report", 0);
    DiagnosedRecordings shown{
        answer_, shown_train(), shown_heldout(), result_.base.point, answer_.fit.point, {}};
    shown.before.initial.clear();
    shown.after.initial.clear();
    for (const MotionSource& source : parts_.heldout) shown.heldout_names.push_back(source.name);
    witness_(shown);
  }

  /// Part of a joint's structure that has no name.
  [[nodiscard]] double nameless_part(const Nameless& nameless) const {
    double named = 0;
    for (std::size_t i = 0; i < result_.winners.size(); ++i) {
      const std::vector<int> joints =
          joints_of(hypotheses_[result_.winners[i].hypothesis].effect, views_.train.joints());
      if (std::find(joints.begin(), joints.end(), nameless.structure.joint) == joints.end()) {
        continue;
      }
      named += answer_.findings[i].evidence.lambda;
    }
    const double left = std::max(0.0, nameless.score.squares - nameless.score.degrees);
    return left / std::max(left + named, 1e-300);
  }

  void conclude() {
    const bool open = std::any_of(
        result_.nameless.begin(), result_.nameless.end(),
        [&](const Nameless& nameless) { return nameless_part(nameless) > kUnexplainedPart; });
    const bool doubted = std::any_of(
        answer_.findings.begin(), answer_.findings.end(),
        [](const Finding& finding) { return !finding.since_reference && finding.doubted; });
    if (open) {
      answer_.verdict = Verdict::kUnexplainedStructure;
      answer_.sentence = answer_.findings.empty()
                             ? "There is structure that no effect of the catalogue explains."
                             : "Effects were found, and there is structure beside them that none "
                               "explains.";
    } else if (doubted) {
      answer_.verdict = Verdict::kUnexplainedStructure;
      answer_.sentence =
          "There is structure beside the model; the effect that is nearest to it has a condition "
          "against it.";
    } else if (!answer_.findings.empty()) {
      answer_.verdict = Verdict::kExplained;
      answer_.sentence = fmt::format(
          "{} left-out effect{} explain{} what the model leaves.", answer_.findings.size(),
          answer_.findings.size() == 1 ? "" : "s", answer_.findings.size() == 1 ? "s" : "");
    } else {
      answer_.verdict = Verdict::kClean;
      answer_.sentence = "Nothing above the noise: the model explains these recordings.";
    }
  }

  const DiagnosisInput& input_;
  const DiagnosisOptions& options_;
  const DiagnosisProgress& progress_;
  const DiagnosisWitness& witness_;
  Division parts_;
  ViewOptions seen_;
  Views views_;
  /// Recordings with the joint state that was chosen and where joints rest, if the views are
  /// others: those that an rms is of.
  struct Whole {
    EffectRecordings train, heldout;
  };
  std::optional<Whole> whole_;
  std::vector<Hypothesis> hypotheses_;
  CompetitionResult result_;
  Diagnosis answer_;
};

}  // namespace

void DiagnosisOptions::validate() const {
  if (!(false_alarm > 0 && false_alarm < 0.5)) {
    throw std::invalid_argument(fmt::format(
        "DiagnosisOptions: false_alarm is {}, expected a number in (0, 0.5)", false_alarm));
  }
  if (most_findings < 0) {
    throw std::invalid_argument(
        fmt::format("DiagnosisOptions: most_findings is {}, expected 0 or more", most_findings));
  }
}

Diagnosis diagnose(const DiagnosisInput& input, const DiagnosisOptions& options,
                   const DiagnosisProgress& progress, const DiagnosisWitness& witness) {
  options.validate();
  try {
    return Diagnostician(input, options, progress, witness).run();
  } catch (const TooShortError& error) {
    Diagnosis answer;
    answer.condition = conditions_of(input);
    answer.sentence = error.what();
    return answer;
  }
}

}  // namespace dyngen::runtime
