// SPDX-License-Identifier: MIT
/// Several effects of one joint: each alone explains less than a function without a name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

EffectLaw ripple_law() {
  EffectLaw law = test::algebraic_law(
      "position_friction", {"q"}, {{"a", EffectRole::kLinear, -10, 10, 0, 1}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * std::sin(2.5 * v[0]); });
  law.family = "torque_ripple";
  return law;
}

EffectLaw drag_law() {
  EffectLaw law = test::algebraic_law(
      "quadratic_drag", {"qd"}, {{"b", EffectRole::kLinear, -10, 10, 0, 1}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * v[0] * std::abs(v[0]); });
  law.family = "quadratic_drag";
  return law;
}

EffectLaw wave_law() {
  EffectLaw law = test::algebraic_law(
      "cogging", {"q", "qd"}, {{"c", EffectRole::kLinear, -10, 10, 0, 1}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * std::cos(3 * v[0]) * v[1]; });
  law.family = "position_friction";
  return law;
}

Diagnosis diagnosed(const std::vector<EffectLaw>& catalogue) {
  const std::vector<EffectInstance> truth = {test::known(ripple_law(), 1, {0.15}),
                                             test::known(drag_law(), 1, {0.1}),
                                             test::known(wave_law(), 1, {0.12})};
  const DiagnosisInput input = test::arm_input(test::two_recordings(truth, 1), truth, catalogue);
  return diagnose(input, test::every_sample());
}

TEST(SeveralEffects, OfAJointAreAllNamed) {
  const Diagnosis answer = diagnosed({ripple_law(), drag_law(), wave_law()});
  EXPECT_EQ(answer.verdict, Verdict::kExplained) << answer.sentence;
  ASSERT_EQ(answer.findings.size(), 3U);
  for (const Finding& finding : answer.findings) {
    EXPECT_EQ(finding.effect.joint, 1);
    EXPECT_GT(finding.probability, 0.9) << finding.effect.law.name;
  }
}

TEST(SeveralEffects, OneThatStandsBesideALargerOneWithoutANameIsADoubt) {
  const Diagnosis answer = diagnosed({drag_law()});
  EXPECT_EQ(answer.verdict, Verdict::kUnexplainedStructure) << answer.sentence;
  EXPECT_FALSE(answer.unexplained.empty());
  for (const Finding& finding : answer.findings) {
    EXPECT_LE(finding.probability, 0.5);
    EXPECT_TRUE(std::any_of(
        finding.tests.begin(), finding.tests.end(),
        [](const FalsifierOutcome& test) { return test.test == "structure" && !test.passed; }));
  }
}

}  // namespace
}  // namespace dyngen::runtime
