// SPDX-License-Identifier: MIT
/// What a diagnosis concludes from findings whose names are certain, uncertain, or as good as none.
#include "runtime/diagnosis/answer/verdict.h"

#include <gtest/gtest.h>

#include "runtime/diagnosis/answer/found_effects.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

/// A search that found a spring of joint 2.
class FoundSpring : public testing::Test {
 protected:
  void SetUp() override {
    CompetitionOptions options;
    options.false_alarm = 0.01;
    options.most_winners = 2;
    search_.compete(options, {});
    findings_ = found_effects(search_, options, {});
    ASSERT_EQ(findings_.size(), 1U);
  }

  Conclusion conclusion() { return concluded(search_, findings_, {}); }

  EffectInstance truth_ = test::known(test::spring_law(), 1, {0.4});
  DiagnosisInput input_ =
      test::arm_input(test::two_recordings({truth_}, 1), {truth_}, {test::spring_law()});
  Search search_{input_, 1};
  std::vector<Finding> findings_;
};

using Verdicts = FoundSpring;

TEST_F(Verdicts, ACertainNameExplains) {
  EXPECT_FALSE(findings_.front().uncertain);
  EXPECT_EQ(conclusion().verdict, Verdict::kExplained);
  EXPECT_NE(conclusion().sentence.find("1 left-out effect explains"), std::string::npos)
      << conclusion().sentence;
}

TEST_F(Verdicts, AnUncertainNameIsNotCountedAsAnExplanation) {
  findings_.front().uncertain = true;
  findings_.front().aliases = {"gravity_spring", "cable"};  // one of these explains
  EXPECT_EQ(conclusion().verdict, Verdict::kExplained);
  EXPECT_EQ(conclusion().sentence.find("explain"), std::string::npos) << conclusion().sentence;
  EXPECT_NE(conclusion().sentence.find("uncertain"), std::string::npos) << conclusion().sentence;
}

TEST_F(Verdicts, WhatHasNoNameAsGoodAsAnUncertainOneIsStructure) {
  findings_.front().uncertain = true;
  findings_.front().aliases = {"gravity_spring"};
  EXPECT_EQ(conclusion().verdict, Verdict::kUnexplainedStructure);
}

TEST(MostFindings, NoMoreEffectsThanAskedForAreSoughtAndSaidSo) {
  const EffectInstance truth = test::known(test::spring_law(), 1, {0.4});
  DiagnosisInput input =
      test::arm_input(test::two_recordings({truth}, 1), {truth}, {test::spring_law()});
  DiagnosisOptions options = test::every_sample();
  options.most_findings = 1;
  const Diagnosis answer = diagnose(input, options);
  ASSERT_EQ(answer.findings.size(), 1U);
  EXPECT_EQ(answer.effort.cut_off, std::vector<std::string>{"effects beyond the first 1"});
}

}  // namespace
}  // namespace dyngen::runtime
