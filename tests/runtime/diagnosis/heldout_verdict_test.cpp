// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/answer/heldout_verdict.h"

#include <gtest/gtest.h>

#include "runtime/estimation/distributions.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

/// Two joints of which held-out torque says nothing against the findings.
struct Held {
  HeldoutResidual rms{VectorXd::Constant(2, 0.5), VectorXd::Constant(2, 0.1),
                      VectorXd::Constant(2, 0.1), VectorXd::Ones(2)};
  HeldoutKnowledge known{VectorXd::Zero(2),          VectorXd::Ones(2), VectorXd::Constant(2, 4000),
                         VectorXd::Constant(2, 900), VectorXd::Zero(2), VectorXd::Constant(2, 0.5),
                         VectorXd::Constant(2, 0.1)};
  [[nodiscard]] std::optional<Conclusion> conclusion(bool found_nothing = false) const {
    return contradicted(rms, known, found_nothing, {true, false});
  }
};

TEST(HeldoutVerdict, TorqueAtTheNoiseSaysNothing) {
  EXPECT_FALSE(Held().conclusion());
  EXPECT_FALSE(Held().conclusion(true));
}

TEST(HeldoutVerdict, WhatIsFasterThanTheEquationsIsNotHeldAgainstThem) {
  Held held;
  held.rms.after[0] = 0.25;
  EXPECT_FALSE(held.conclusion());
}

TEST(HeldoutVerdict, TorqueFarAboveTheNoiseIsNotExplained) {
  Held held;
  held.rms.after[1] = 0.4;
  const auto conclusion = held.conclusion();
  ASSERT_TRUE(conclusion);
  EXPECT_EQ(conclusion->verdict, Verdict::kNotExplained);
  EXPECT_EQ(conclusion->sentence,
            "Effects were found, but held-out torque is not predicted: 0.4 N of joint 2, beside a "
            "noise of 0.1 (without the samples near reversals).");
}

TEST(HeldoutVerdict, EquationsAboveTheNoiseAreNotExplained) {
  Held held;
  held.known.equations[0] = 1.5 * 1.5;
  const auto conclusion = held.conclusion();
  ASSERT_TRUE(conclusion);
  EXPECT_EQ(conclusion->sentence,
            "Effects were found, but held-out torque is not predicted: 0.1 N m of joint 1, 1.5 "
            "times the noise in its equations (without the samples near reversals).");
}

TEST(HeldoutVerdict, AJointThatIsNotJudgedSaysNothing) {
  Held held;
  held.rms.after[1] = 0.4;
  held.known.masked = {true, false};
  EXPECT_TRUE(held.conclusion());
  held.known.masked = {false, true};
  EXPECT_FALSE(held.conclusion());
  EXPECT_FALSE(held.conclusion(true));
}

// Fisher's F: the same ratio of few equations is chance
TEST(HeldoutVerdict, FewEquationsAreChance) {
  Held held;
  held.known.equations[0] = 1.5 * 1.5;
  held.known.heldout_worth[0] = 8;
  ASSERT_GT(variance_ratio_tail(1.5 * 1.5, 8, 4000), AnswerRules().heldout_chance);
  EXPECT_FALSE(held.conclusion());
}

TEST(HeldoutVerdict, OpenParametersMayMoveIt) {
  Held held;
  held.known.equations[0] = 1.5 * 1.5;
  held.known.predicted[0] = 1;
  EXPECT_FALSE(held.conclusion());
}

TEST(HeldoutVerdict, FindingsThatMakeItWorseAreNotExplained) {
  Held held;
  held.known.without[0] = 0.09;
  held.known.worse[0] = 10;
  const auto conclusion = held.conclusion();
  ASSERT_TRUE(conclusion);
  EXPECT_EQ(conclusion->sentence,
            "Effects were found, but held-out torque is not predicted: 0.1 N m of joint 1, 0.09 "
            "without the findings (without the samples near reversals).");
  held.known.with_reversals = true;
  EXPECT_EQ(held.conclusion()->sentence,
            "Effects were found, but held-out torque is not predicted: 0.1 N m of joint 1, 0.09 "
            "without the findings.");
  held.known.without[0] = 0.099;  // 1 %: the digits that are printed are the same
  EXPECT_FALSE(held.conclusion());
}

TEST(HeldoutVerdict, WhereMotionIsNewNothingFoundIsInsufficient) {
  Held held;
  held.rms.after[0] = 0.4;
  EXPECT_EQ(held.conclusion(true)->verdict, Verdict::kNotExplained);
  held.rms.visited[0] = 0.5;
  EXPECT_EQ(held.conclusion(true)->verdict, Verdict::kInsufficientData);
  EXPECT_EQ(held.conclusion()->verdict, Verdict::kNotExplained);
}

}  // namespace
}  // namespace dyngen::runtime
