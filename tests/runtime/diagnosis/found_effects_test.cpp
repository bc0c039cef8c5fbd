// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/answer/found_effects.h"

#include <gtest/gtest.h>

#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

/// A search among springs of both joints, of which joint 2 has one or none.
std::vector<Finding> found_springs(double stiffness) {
  const EffectInstance truth = test::known(test::spring_law(), 1, {stiffness});
  const DiagnosisInput input =
      test::arm_input(test::two_recordings({truth}, 1), {truth}, {test::spring_law()});
  CompetitionOptions options;
  options.false_alarm = 0.01;
  options.most_winners = 2;
  Search search(input, 1);
  search.compete(options, {});
  return found_effects(search, options, {});
}

TEST(FoundEffects, SayWhatTheWinnerIsAndHowMuchItExplains) {
  const std::vector<Finding> findings = found_springs(0.4);
  ASSERT_EQ(findings.size(), 1U);
  const Finding& finding = findings.front();
  EXPECT_EQ(finding.effect.joint, 1);
  ASSERT_EQ(finding.parameters.size(), 1U);
  EXPECT_NEAR(finding.effect.parameters[0], 0.4, 4.5 * finding.parameters[0].stddev);
  EXPECT_EQ(finding.aliases, std::vector<std::string>{"gravity_spring"});
  EXPECT_GT(finding.evidence.lambda, 60);
  EXPECT_GT(finding.probability, 0.9);
  EXPECT_FALSE(finding.doubted);
  EXPECT_GT(finding.where.share, 0);
  EXPECT_LT(finding.where.share, 1 + 1e-9);
  EXPECT_NE(finding.why.find("gravity_spring on joint 2 lowers chi-square"), std::string::npos)
      << finding.why;
}

TEST(FoundEffects, AreNoneWithoutAWinner) { EXPECT_TRUE(found_springs(0).empty()); }

}  // namespace
}  // namespace dyngen::runtime
