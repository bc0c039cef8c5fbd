// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/second_scan.h"

#include <gtest/gtest.h>

#include "tests/runtime/diagnosis/arm_competition.h"

namespace dyngen::runtime {
namespace {

/// A winner at some values of its parameters, of recordings that have the truth.
struct SecondLook {
  SecondLook(const EffectInstance& truth, const EffectInstance& winner, const EffectInstance& asked)
      : arm(test::everywhere({truth})),
        hypotheses{arm.hypothesis(asked)},
        sought(sought_in(arm.evidence, hypotheses)),
        result(arm.nothing_found()) {
    result.winners.emplace_back();
    result.fit = before = fit_effects(arm.evidence, {winner});
    moved = scan_again(arm.data, sought, {}, result);
  }
  [[nodiscard]] const EffectInstance& found() const { return result.fit.point.effects[0]; }

  test::ArmCompetition arm;
  std::vector<Hypothesis> hypotheses;
  Sought sought;
  CompetitionResult result;
  EffectFit before;
  bool moved = false;
};

TEST(SecondScan, CorrectsAScannedValue) {
  const EffectInstance truth = test::known(test::ripple_law(), 0, {0.2, 0.1, 20});
  EffectInstance wrong = test::unknown(test::ripple_law(), 0);
  wrong.parameters[2] = 33;
  const SecondLook look(truth, wrong, test::unknown(test::ripple_law(), 0));
  EXPECT_TRUE(look.moved);
  EXPECT_NEAR(look.found().parameters[2], 20, 0.1);
  EXPECT_EQ(look.result.winners[0].trial.effect.parameters[2], look.found().parameters[2]);
}

TEST(SecondScan, LeavesWhatIsFittedAlone) {
  const EffectInstance spring = test::known(test::spring_law(), 1, {0.4});
  const SecondLook look(spring, spring, test::unknown(test::spring_law(), 1));
  EXPECT_FALSE(look.moved);
  EXPECT_EQ(look.found().parameters[0], look.before.point.effects[0].parameters[0]);
}

}  // namespace
}  // namespace dyngen::runtime
