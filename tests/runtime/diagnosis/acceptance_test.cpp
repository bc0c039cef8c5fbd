// SPDX-License-Identifier: MIT
/// What makes a winner of an effect that came first in a round.
#include "runtime/diagnosis/competition/acceptance.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/runtime/diagnosis/arm_competition.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

constexpr double kStiffness = 0.4;  // N m/rad

EffectInstance spring_that_acts() { return test::known(test::spring_law(), 1, {kStiffness}); }

/// A spring of joint 2 that is never stiffer.
EffectInstance spring_up_to(double stiffest) {
  return test::unknown(
      test::algebraic_law("bounded", {"q"}, {{"k", EffectRole::kLinear, -10, stiffest, 0.1, 0.3}},
                          [](const VectorXd& v, const VectorXd& p) { return p[0] * v[0]; }),
      1);
}

/// A round in which a spring came first.
struct SpringRound {
  explicit SpringRound(const test::ArmEffects& effects,
                       double stiffest = std::numeric_limits<double>::infinity())
      : arm(effects),
        hypotheses{arm.hypothesis(spring_up_to(stiffest))},
        sought(sought_in(arm.evidence, hypotheses)),
        result(arm.nothing_found()),
        acceptance(arm.data, sought, {}, 0.002, result) {
    acceptance.begin_round();
    screening.named = {arm.named(sought, 0)};
  }

  [[nodiscard]] Acceptance::Candidate candidate() const {
    return {screening.named[0], fit_effects(arm.evidence, {spring_up_to_bound()}), false, false};
  }
  [[nodiscard]] EffectInstance spring_up_to_bound() const {
    EffectInstance effect = hypotheses[0].effect;
    effect.parameters.setConstant(std::numeric_limits<double>::quiet_NaN());
    return effect;
  }

  test::ArmCompetition arm;
  std::vector<Hypothesis> hypotheses;
  Sought sought;
  CompetitionResult result;
  Acceptance acceptance;
  Screening screening;
};

TEST(Acceptance, ReturnsAWinnerThatHeldOutRecordingsHave) {
  SpringRound round(test::everywhere({spring_that_acts()}));
  const auto accepted = round.acceptance.accept(round.candidate(), round.screening);
  ASSERT_TRUE(accepted);
  EXPECT_EQ(accepted->winner.hypothesis, 0U);
  EXPECT_EQ(accepted->winner.others.size(), 1U);
  ASSERT_EQ(accepted->fit.point.effects.size(), 1U);
  EXPECT_NEAR(accepted->fit.point.effects[0].parameters[0], kStiffness, 0.1);
  // the caller decides what becomes of it
  EXPECT_TRUE(round.result.winners.empty());
  EXPECT_TRUE(round.result.fit.point.effects.empty());
}

TEST(Acceptance, RefusesWhatHeldOutRecordingsDoNotHave) {
  SpringRound round({{spring_that_acts()}, {spring_that_acts()}, {}});
  EXPECT_FALSE(round.acceptance.accept(round.candidate(), round.screening));
  // not even beyond doubt: they speak against it
  Acceptance::Candidate sure = round.candidate();
  sure.beyond_doubt = true;
  EXPECT_FALSE(round.acceptance.accept(std::move(sure), round.screening));
}

/// Beside a form that explains more, held-out recordings have to speak for an effect.
TEST(Acceptance, TakesWhatIsBesideABetterFormOnlyWithHeldOutRecordings) {
  SpringRound round(test::everywhere({spring_that_acts()}));
  Acceptance::Candidate candidate = round.candidate();
  candidate.beside = EffectConditions::Beside::kBetterForm;
  EXPECT_TRUE(round.acceptance.accept(candidate, round.screening));
  SpringRound without({{spring_that_acts()}, {spring_that_acts()}, {}});
  Acceptance::Candidate alone = without.candidate();
  alone.beside = EffectConditions::Beside::kBetterForm;
  EXPECT_FALSE(without.acceptance.accept(std::move(alone), without.screening));
}

TEST(Acceptance, RefusesWhatTheHalfBandContradicts) {
  SpringRound round({{spring_that_acts()}, {}, {spring_that_acts()}});
  EXPECT_FALSE(round.acceptance.accept(round.candidate(), round.screening));
}

TEST(Acceptance, PutsOffWhatStandsAtABound) {
  SpringRound round(test::everywhere({spring_that_acts()}), 0.85 * kStiffness);
  EXPECT_FALSE(round.acceptance.accept(round.candidate(), round.screening));
  const auto accepted = round.acceptance.accept_at_bound(round.screening);
  ASSERT_TRUE(accepted);
  EXPECT_DOUBLE_EQ(accepted->fit.point.effects[0].parameters[0], 0.85 * kStiffness);
  // once
  EXPECT_FALSE(round.acceptance.accept_at_bound(round.screening));
}

TEST(Acceptance, ForgetsWhatStoodAtABoundInAnotherRound) {
  SpringRound round(test::everywhere({spring_that_acts()}), 0.85 * kStiffness);
  EXPECT_FALSE(round.acceptance.accept(round.candidate(), round.screening));
  round.acceptance.begin_round();
  EXPECT_FALSE(round.acceptance.accept_at_bound(round.screening));
}

}  // namespace
}  // namespace dyngen::runtime
