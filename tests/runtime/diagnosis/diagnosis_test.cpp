// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/diagnosis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

#include "runtime/diagnosis/equation_sets/sufficiency.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A small catalogue of laws made by hand, on both joints where they are of one.
std::vector<EffectInstance> small_catalogue() {
  EffectLaw asymmetry = test::coulomb_asymmetry_law();
  asymmetry.aliases.emplace_back("base");
  std::vector<EffectInstance> hypotheses =
      test::on_both_joints({test::stribeck_law(), test::load_friction_law(), test::spring_law(),
                            test::ripple_law(), asymmetry});
  EffectInstance tilt = test::unknown(test::tilt_law(), -1);
  tilt.law.family = tilt.law.name;
  hypotheses.push_back(std::move(tilt));
  return hypotheses;
}

DiagnosisInput input_with(const std::vector<EffectInstance>& effects, unsigned seed,
                          double noise = 0.1, double coefficient = 0.5) {
  const double phase = 0.3 * seed;
  DiagnosisInput input;
  input.model = test::planar_arm();
  input.robot = test::planar_arm_tangents();
  input.train = test::measured({test::sines(30, 0.01, phase), test::sines(30, 0.01, phase + 2)},
                               test::planar_arm_values(), effects, noise, coefficient, seed);
  input.heldout = test::measured({test::sines(20, 0.01, phase + 4, 0.9)}, test::planar_arm_values(),
                                 effects, noise, coefficient, seed + 100);
  input.hypotheses = small_catalogue();
  return input;
}

TEST(Diagnosis, OfNullsIsClean) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const double coefficient = seed % 3 == 0 ? 0 : seed % 3 == 1 ? 0.5 : 0.95;
    const Diagnosis diagnosis =
        diagnose(input_with({}, seed, 0.1, coefficient), test::every_sample());
    EXPECT_EQ(diagnosis.verdict, Verdict::kClean) << "seed " << seed << " AR " << coefficient;
    EXPECT_TRUE(diagnosis.findings.empty());
  }
}

struct Truth {
  EffectInstance effect;
  int joint;
};

TEST(Diagnosis, NamesWhatWasLeftOut) {
  const std::vector<Truth> truths = {{test::known(test::load_friction_law(), 0, {0.05}), 0},
                                     {test::known(test::spring_law(), 1, {0.4}), 1},
                                     {test::known(test::ripple_law(), 1, {0.1, 0.05, 21}), 1},
                                     {test::known(test::tilt_law(), -1, {0.2, 0.1}), -1}};
  for (const Truth& truth : truths) {
    for (const unsigned seed : {1U, 2U}) {
      const Diagnosis diagnosis = diagnose(input_with({truth.effect}, seed), test::every_sample());
      ASSERT_FALSE(diagnosis.findings.empty()) << truth.effect.law.name << " seed " << seed;
      const Finding& finding = diagnosis.findings.front();
      EXPECT_EQ(finding.effect.law.name, truth.effect.law.name) << "seed " << seed;
      EXPECT_EQ(finding.effect.joint, truth.joint);
      EXPECT_GT(finding.evidence.lambda, 20);
      EXPECT_LT(finding.evidence.delta_bic, 0);
      EXPECT_GT(finding.evidence.heldout_gain, 0);
      EXPECT_GT(diagnosis.heldout.visited.minCoeff(), 0.1);
      EXPECT_LE(diagnosis.heldout.visited.maxCoeff(), 1);
      EXPECT_GT(finding.where.share, 0.5);
      EXPECT_FALSE(finding.why.empty());
      for (int p = 0; p < truth.effect.law.size(); ++p) {
        const EffectRole role = truth.effect.law.parameters[static_cast<std::size_t>(p)].role;
        // an order is held at what a scan found: a phase of 0.1 rad at the ends of the range
        const double held = role == EffectRole::kScanned ? 0.1 : 0.1 * truth.effect.parameters[0];
        EXPECT_NEAR(finding.effect.parameters[p], truth.effect.parameters[p],
                    4.5 * finding.parameters[static_cast<std::size_t>(p)].stddev + held)
            << truth.effect.law.name;
      }
    }
  }
}

/// A bound on the work gives what was found by then, names what was not searched, and calls nothing
/// clean that it did not look at.
TEST(Diagnosis, EndsWhereItsEffortIsSpent) {
  const EffectInstance spring = test::known(test::spring_law(), 1, {0.4});
  const DiagnosisInput input = input_with({spring}, 1), null = input_with({}, 1);
  DiagnosisOptions options = test::every_sample();
  const Diagnosis all = diagnose(input, options);
  ASSERT_EQ(all.findings.size(), 1U);
  EXPECT_GT(all.effort.done, 0);
  EXPECT_EQ(all.effort.most, 0);
  EXPECT_TRUE(all.effort.cut_off.empty());

  options.effort = 1e-6;
  const Diagnosis least = diagnose(input, options);
  EXPECT_TRUE(least.findings.empty());
  EXPECT_EQ(least.effort.cut_off, std::vector<std::string>{"further effects"});
  EXPECT_EQ(least.verdict, Verdict::kInsufficientData);
  EXPECT_NE(least.sentence.find("further effects"), std::string::npos) << least.sentence;
  EXPECT_LT(least.effort.done, all.effort.done);
  EXPECT_EQ(diagnose(null, options).verdict, Verdict::kInsufficientData);

  // enough for the first effect, and for nothing beside it
  options.effort = 0.5 * (least.effort.done + all.effort.done);
  const Diagnosis some = diagnose(input, options);
  ASSERT_EQ(some.findings.size(), 1U) << some.sentence;
  EXPECT_EQ(some.findings.front().effect.law.name, spring.law.name);
  EXPECT_FALSE(some.effort.cut_off.empty());
  EXPECT_LT(some.effort.done, all.effort.done);

  options.effort = 2 * all.effort.done;
  const Diagnosis enough = diagnose(input, options);
  EXPECT_EQ(enough.effort.done, all.effort.done);
  EXPECT_TRUE(enough.effort.cut_off.empty());
  EXPECT_EQ(enough.sentence, all.sentence);

  options.effort = -1;
  EXPECT_THROW(diagnose(input, options), std::invalid_argument);
}

/// A factor on the torque of one of two joints is, but for a factor on all of them, one on the
/// other.
TEST(Diagnosis, SaysOnWhichOtherJointAnEffectWouldDoAsWell) {
  EffectLaw gain = test::algebraic_law(
      "torque_gain", {"torque"}, {{"gain", EffectRole::kLinear, -0.9, 10, 0, -0.05}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * v[0]; });
  gain.kind = EffectKind::kTangent;
  EffectInstance truth = test::known(gain, 1, {-0.02});
  truth.link = 2;
  const Diagnosis diagnosis = diagnose(
      test::arm_input(test::two_recordings({truth}, 5), {truth}, {gain}), test::every_sample());
  ASSERT_EQ(diagnosis.findings.size(), 1U) << diagnosis.sentence;
  const Finding& finding = diagnosis.findings.front();
  EXPECT_EQ(finding.effect.law.family, "torque_gain");
  const int other = finding.effect.joint == 0 ? 2 : 1;
  EXPECT_EQ(finding.elsewhere.find("the same of joint " + std::to_string(other)), 0U)
      << finding.elsewhere;
  EXPECT_NE(finding.why.find("cannot separate it from " + finding.elsewhere), std::string::npos)
      << finding.why;

  const EffectInstance spring = test::known(test::spring_law(), 1, {0.4});
  const Diagnosis clear =
      diagnose(test::arm_input(test::two_recordings({spring}, 5), {spring}, {test::spring_law()}),
               test::every_sample());
  ASSERT_EQ(clear.findings.size(), 1U) << clear.sentence;
  EXPECT_EQ(clear.findings.front().elsewhere, "");
}

/// A coupling of joint 1 to joint 2 is that of joint 2 to joint 1.
TEST(Diagnosis, TheSameTwoJointsTheOtherWayRoundAreNoOtherPlace) {
  EffectLaw coupling = test::algebraic_law(
      "coupling", {"q", "q_other"}, {{"size", EffectRole::kLinear, -10, 10, 0, 0.1}},
      [](const VectorXd& v, const VectorXd& p) {
        return p[0] * (std::sin(3 * v[0]) + std::sin(3 * v[1]));
      });
  coupling.scope = EffectScope::kPair;
  coupling.acts_on_all = true;
  std::vector<EffectInstance> hypotheses = test::on_both_joints({coupling});
  hypotheses[0].other = 1;
  hypotheses[1].other = 0;
  EffectInstance truth = hypotheses[0];
  truth.parameters[0] = 0.2;
  DiagnosisInput input = test::arm_input(test::two_recordings({truth}, 5), {truth}, {});
  input.hypotheses = hypotheses;
  const Diagnosis diagnosis = diagnose(input, test::every_sample());
  ASSERT_EQ(diagnosis.findings.size(), 1U) << diagnosis.sentence;
  EXPECT_EQ(diagnosis.findings.front().elsewhere, "");
}

/// Of two effects of one joint the share of each is of what both leave there.
TEST(Diagnosis, SharesAreOfAllThatIsFoundOnTheJoint) {
  const EffectInstance ripple = test::known(test::ripple_law(), 1, {0.1, 0.05, 21});
  const auto shares = [&](const std::vector<EffectInstance>& truths) {
    const Diagnosis diagnosis = diagnose(input_with(truths, 1), test::every_sample());
    std::map<std::string, double> by_name;
    for (const Finding& own : diagnosis.findings) {
      by_name[own.effect.law.name] = own.where.share;
    }
    return by_name;
  };
  const std::string name = ripple.law.name;
  const double alone = shares({ripple}).at(name);
  EXPECT_GT(alone, 0.65);
  EXPECT_LE(alone, 1);
  const auto both = shares({ripple, test::known(test::spring_law(), 1, {0.4})});
  ASSERT_EQ(both.size(), 2U);
  const double other = both.at(test::spring_law().name);
  EXPECT_LT(both.at(name), 0.8 * alone);
  EXPECT_LE(both.at(name) + other, 1 + 1e-12);
  EXPECT_GT(both.at(name) + other, 0.6);
}

TEST(Diagnosis, WhatIsAColumnOfTheModelIsUndecidable) {
  const Diagnosis diagnosis = diagnose(
      input_with({test::known(test::coulomb_asymmetry_law(), 0, {1.0})}, 3), test::every_sample());
  EXPECT_EQ(diagnosis.verdict, Verdict::kClean);
  const auto listed = std::any_of(
      diagnosis.undecidable.begin(), diagnosis.undecidable.end(), [](const Undecidable& entry) {
        return entry.joint == 0 && std::find(entry.families.begin(), entry.families.end(),
                                             "coulomb_asymmetry") != entry.families.end();
      });
  EXPECT_TRUE(listed);
}

TEST(Diagnosis, AReferenceDecidesWhatNoRecordingAloneCan) {
  DiagnosisInput input = input_with({test::known(test::coulomb_asymmetry_law(), 0, {1.0})}, 4);
  input.reference = input_with({}, 5).train;
  const Diagnosis diagnosis = diagnose(input, test::every_sample());
  ASSERT_EQ(diagnosis.findings.size(), 1U);
  const Finding& finding = diagnosis.findings.front();
  EXPECT_TRUE(finding.since_reference);
  EXPECT_EQ(finding.effect.law.name, "coulomb_asymmetry");
  EXPECT_EQ(finding.effect.joint, 0);
  EXPECT_NEAR(finding.effect.parameters[0], 1, 5 * finding.parameters[0].stddev);
  EXPECT_TRUE(finding.where.variable.empty());
  EXPECT_TRUE(std::isnan(finding.where.share));
  EXPECT_EQ(diagnosis.sentence,
            "1 change since the reference recordings, which the model's own parameters have taken "
            "up.");
  input.train = input_with({}, 6).train;
  EXPECT_TRUE(diagnose(input, test::every_sample()).findings.empty());
}

TEST(Diagnosis, StructureOutsideTheCatalogueHasNoName) {
  EffectLaw foreign = test::algebraic_law(
      "foreign", {"q", "q_other"}, {{"a", EffectRole::kLinear, -10, 10, 0, 1}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * std::sin(3 * v[0]) * v[1]; });
  foreign.scope = EffectScope::kPair;
  EffectInstance effect = test::known(foreign, 0, {0.6});
  effect.other = 1;
  const Diagnosis diagnosis = diagnose(input_with({effect}, 7), test::every_sample());
  EXPECT_EQ(diagnosis.verdict, Verdict::kUnexplainedStructure);
  ASSERT_FALSE(diagnosis.unexplained.empty());
  EXPECT_EQ(diagnosis.unexplained.front().joint, 0);
  EXPECT_GT(diagnosis.unexplained.front().rms, 0.02);
}

TEST(Diagnosis, IsTheSameTwice) {
  const DiagnosisInput input = input_with({test::known(test::spring_law(), 1, {0.4})}, 8);
  const Diagnosis a = diagnose(input, test::every_sample()),
                  b = diagnose(input, test::every_sample());
  EXPECT_EQ(a.findings.size(), b.findings.size());
  EXPECT_EQ(a.fit.point.beta, b.fit.point.beta);
  EXPECT_EQ(a.heldout.after, b.heldout.after);
  ASSERT_EQ(a.before.size(), b.before.size());
  for (std::size_t j = 0; j < a.before.size(); ++j) {
    EXPECT_EQ(a.before[j].statistic, b.before[j].statistic);
    EXPECT_EQ(a.before[j].threshold, b.before[j].threshold);
  }
}

TEST(Diagnosis, OfAFewSamplesIsRefused) {
  DiagnosisInput input = input_with({}, 9);
  input.train = test::measured({test::sines(0.3, 0.01)}, test::planar_arm_values(), {}, 0.1, 0, 1);
  const Diagnosis diagnosis = diagnose(input, test::every_sample());
  EXPECT_EQ(diagnosis.verdict, Verdict::kInsufficientData);
  EXPECT_FALSE(diagnosis.sentence.empty());
}

/// The whole arm has 13 parameters. On the motion of the fit the variances of all predictions add
/// up to those of 13 residuals; on a motion that the fit has not seen there is no such bound.
TEST(PredictedVariance, IsThatOfTheParametersOverTheEquations) {
  const auto equations = [](double seconds, double phase) {
    return effect_recordings(test::planar_arm(), test::planar_arm_tangents(),
                             test::measured({test::sines(seconds, 0.01, phase)},
                                            test::planar_arm_values(), {}, 0.1, 0, 3),
                             {1, -1});
  };
  const EffectRecordings data = equations(30, 0.3);
  const VectorXd own = predicted_variance(data, data);
  EXPECT_NEAR(own.sum() * static_cast<double>(data.equations()), 13, 3);
  const VectorXd other = predicted_variance(equations(0.7, 0.3), data);
  EXPECT_GT(other.maxCoeff(), 1);
}

TEST(Diagnosis, OfAMotionTooShortForItsParametersIsRefused) {
  DiagnosisInput input = input_with({test::known(test::spring_law(), 1, {0.4})}, 9);
  for (const double seconds : {0.8, 1.2}) {
    input.train =
        test::measured({test::sines(seconds, 0.01)}, test::planar_arm_values(), {}, 0.1, 0.5, 1);
    const Diagnosis diagnosis = diagnose(input, test::every_sample());
    EXPECT_EQ(diagnosis.verdict, Verdict::kInsufficientData) << seconds;
    EXPECT_NE(diagnosis.sentence.find("too little motion"), std::string::npos)
        << diagnosis.sentence;
    EXPECT_TRUE(diagnosis.findings.empty());
  }
}

/// Recordings that cannot be called clean can still hold an effect that is far above the noise.
TEST(Diagnosis, OfAShortMotionNamesWhatIsStrong) {
  const std::vector<EffectInstance> ripple = {test::known(test::ripple_law(), 1, {0.6, 0.5, 24})};
  DiagnosisInput input = input_with(ripple, 9);
  const auto brief = [](const std::vector<EffectInstance>& effects) {
    return test::measured({test::sines(2.5, 0.01)}, test::planar_arm_values(), effects, 0.1, 0.5,
                          1);
  };
  input.train = brief({});
  EXPECT_EQ(diagnose(input, test::every_sample()).verdict, Verdict::kInsufficientData);
  input.train = brief(ripple);
  const Diagnosis diagnosis = diagnose(input, test::every_sample());
  ASSERT_EQ(diagnosis.findings.size(), 1U) << diagnosis.sentence;
  EXPECT_EQ(diagnosis.findings[0].effect.law.name, "torque_ripple");
}

TEST(Diagnosis, OfARunShorterThanTheFilterSaysSo) {
  DiagnosisOptions options;
  options.decimation = 20;
  DiagnosisInput input = input_with({}, 9);
  const std::vector<MotionSource> brief =
      test::measured({test::sines(0.5, 0.01)}, test::planar_arm_values(), {}, 0.1, 0, 1);
  for (std::vector<MotionSource> DiagnosisInput::*part :
       {&DiagnosisInput::heldout, &DiagnosisInput::train}) {
    input.*part = brief;
    const Diagnosis diagnosis = diagnose(input, options);
    EXPECT_EQ(diagnosis.verdict, Verdict::kInsufficientData);
    EXPECT_NE(diagnosis.sentence.find("is longer than the parallel filter: the longest has 0.5 s"),
              std::string::npos)
        << diagnosis.sentence;
    EXPECT_EQ(diagnosis.condition.size(), input.train.size() + input.heldout.size());
  }
}

TEST(DiagnosisOptions, AreCheckedByName) {
  DiagnosisOptions options;
  options.false_alarm = 0;
  EXPECT_THROW(options.validate(), std::invalid_argument);
  options = {};
  options.most_findings = -1;
  EXPECT_THROW(options.validate(), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
