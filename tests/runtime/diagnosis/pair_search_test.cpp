// SPDX-License-Identifier: MIT
/// Two effects of which neither is found while the other is left out.
#include "runtime/diagnosis/competition/pair_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

/// A wave over the position of each joint, on all of them. @param largest  bound of its size, N m
EffectInstance all_over(const std::string& name, double largest,
                        double (*torque)(double position)) {
  EffectLaw law = test::algebraic_law(
      name, {"q"}, {{"size", EffectRole::kLinear, -largest, largest, 0, 0.1}},
      [torque](const VectorXd& v, const VectorXd& p) { return p[0] * torque(v[0]); });
  law.scope = EffectScope::kRobot;
  law.acts_on_all = true;
  law.family = name;
  return test::unknown(law, -1);
}

double third(double q) { return std::sin(3 * q); }
double fifth(double q) { return std::sin(5 * q); }
double both(double q) { return std::sin(3 * q) + std::sin(5 * q); }

/// Two waves, and their sum, which is never so large.
std::vector<EffectInstance> waves() {
  return {all_over("third", 10, third), all_over("fifth", 10, fifth), all_over("both", 0.05, both)};
}

DiagnosisInput input_of(double size_of_third, double size_of_fifth, unsigned seed) {
  std::vector<EffectInstance> truths = {waves()[0], waves()[1]};
  truths[0].parameters[0] = size_of_third;
  truths[1].parameters[0] = size_of_fifth;
  // three periods of 20 s: where no motion repeats effects are found by their likelihood
  const double speed = std::acos(-1.0);
  DiagnosisInput input = test::arm_input(
      test::measured({test::sines(60, 0.01, 0.3, speed), test::sines(60, 0.01, 2.3, speed)},
                     test::planar_arm_values(), truths, test::kArmNoise, 0, seed),
      truths, {});
  input.hypotheses = waves();
  return input;
}

TEST(PairSearch, FindsTwoEffectsThatTheFormOfAnotherOutdoes) {
  const Diagnosis diagnosis = diagnose(input_of(0.2, 0.2, 1), test::every_sample());
  EXPECT_EQ(diagnosis.verdict, Verdict::kExplained);
  ASSERT_EQ(diagnosis.findings.size(), 2U);
  std::vector<std::string> names;
  for (const Finding& finding : diagnosis.findings) {
    names.push_back(finding.effect.law.name);
    EXPECT_NEAR(finding.effect.parameters[0], 0.2, 4.5 * finding.parameters[0].stddev);
    // against the model with the other one alone: noise of 0.1 beside a wave of 0.2, on each joint
    EXPECT_NEAR(finding.evidence.heldout_gain, 1 - 0.1 / std::hypot(0.1, 0.2 / std::sqrt(2)), 0.1);
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"fifth", "third"}));
}

TEST(PairSearch, LeavesOneEffectAlone) {
  const Diagnosis diagnosis = diagnose(input_of(0.2, 0, 2), test::every_sample());
  ASSERT_EQ(diagnosis.findings.size(), 1U);
  EXPECT_EQ(diagnosis.findings.front().effect.law.name, "third");
}

/// Of a screening whose squares are given: who is among the pairs.
TEST(StrongestPairs, AreOfEffectsThatActOnSeveralJoints) {
  const EffectRecordings data = test::arm_recordings(test::two_recordings({}, 3));
  EffectSignals signals(data);
  signals.set_beta(test::planar_arm_values());
  const EvidenceSystem system = test::arm_system(data);
  std::vector<EffectInstance> effects = waves();
  for (const EffectInstance& spring : test::on_both_joints({test::spring_law()})) {
    effects.push_back(spring);
  }
  const ScaleTable scales(data);
  std::vector<Hypothesis> hypotheses;
  Screening screening;
  for (const EffectInstance& effect : effects) {
    const EffectScales own = scales.of(test::planar_arm_values(), effect);
    hypotheses.push_back(hypothesis_of(effect, own));
    NamedResult named;
    named.hypothesis = hypotheses.size() - 1;
    named.freest = named.best = try_hypothesis(data, signals, system, hypotheses.back(),
                                               hypotheses.back().effect, own, false);
    screening.named.push_back(named);
  }
  CompetitionResult result;
  result.noise = test::arm_noise();
  const auto pairs = strongest_pairs(data, signals, system, hypotheses, screening, result);
  ASSERT_EQ(pairs.size(), 3U);
  for (const EffectPair& pair : pairs) {
    EXPECT_LT(std::max(pair.stronger, pair.weaker), 3U);
    EXPECT_LT(pair.net, 0);  // noise alone
    EXPECT_GE(pair.surprise, 0);
    EXPECT_LT(pair.surprise, 5);
  }
  EXPECT_GE(pairs[0].net, pairs[1].net);
  result.winners.emplace_back().hypothesis = 0;
  EXPECT_EQ(strongest_pairs(data, signals, system, hypotheses, screening, result).size(), 1U);
  screening.named[1].seen = false;
  EXPECT_TRUE(strongest_pairs(data, signals, system, hypotheses, screening, result).empty());
}

}  // namespace
}  // namespace dyngen::runtime
