// SPDX-License-Identifier: MIT
/// Which effects of a round may win, in which order.
#include "runtime/diagnosis/competition/ranked_effects.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/runtime/diagnosis/arm_competition.h"

namespace dyngen::runtime {
namespace {

constexpr double kFalseAlarm = 0.01;

/// Springs of both joints, that of joint 2 far the stronger.
struct SpringsRound {
  SpringsRound()
      : arm(test::everywhere(
            {test::known(test::spring_law(), 0, {1}), test::known(test::spring_law(), 1, {4})})),
        hypotheses{arm.hypothesis(test::unknown(test::spring_law(), 0)),
                   arm.hypothesis(test::unknown(test::spring_law(), 1))},
        sought(sought_in(arm.evidence, hypotheses)),
        result(arm.nothing_found()),
        stiction(arm.data, sought, result.sticking, kFalseAlarm),
        conditions(arm.data, sought, stiction, result),
        nameless(arm.data, sought, stiction, {}, kFalseAlarm, result),
        judges{arm.data, sought, stiction, conditions, nameless, result, kFalseAlarm},
        readers(arm.evidence),
        system(test::arm_system(arm.evidence)) {
    readers.set_beta(result.fit.point.beta);
    for (std::size_t place = 0; place < hypotheses.size(); ++place) {
      screening.named.push_back(arm.named(sought, place));
    }
  }

  /// A function of a joint's motion that explains as much.
  void add_function(int joint, double squares) {
    for (std::size_t place = 0; place < sought.structures.size(); ++place) {
      const GenericStructure& structure = sought.structures[place];
      if (structure.joint != joint || structure.form != GenericStructure::Form::kFunction) continue;
      GenericResult generic;
      generic.structure = place;
      generic.score.delta_chi2 = squares;
      generic.score.degrees = 4;
      screening.generic.push_back(generic);
      return;
    }
    FAIL() << "no function of joint " << joint + 1;
  }
  [[nodiscard]] double net(std::size_t place) const {
    return sought.net(screening.named[place], result.noise);
  }
  RankedEffects ranked() { return {judges, system, screening, readers, {}}; }

  test::ArmCompetition arm;
  std::vector<Hypothesis> hypotheses;
  Sought sought;
  CompetitionResult result;
  StictionImpulses stiction;
  EffectConditions conditions;
  NamelessSearch nameless;
  RoundJudges judges;
  ScreeningData readers;
  EvidenceSystem system;
  Screening screening;
};

/// Places that are handed out, each turned down.
std::vector<std::size_t> handed_out(RankedEffects& ranked, bool outdone) {
  std::vector<std::size_t> places;
  while (const std::optional<RankedEffect> own = ranked.next(outdone)) {
    places.push_back(own->hypothesis);
    ranked.tried(own->hypothesis);
  }
  return places;
}

TEST(RankedEffects, AreHandedOutOnceTheBestFirst) {
  SpringsRound round;
  ASSERT_GT(round.net(1), round.net(0));
  ASSERT_GT(round.net(0), 0);
  RankedEffects ranked = round.ranked();
  EXPECT_EQ(handed_out(ranked, false), (std::vector<std::size_t>{1, 0}));
  EXPECT_TRUE(ranked.stopped().contains(1));  // turned down before the other was asked
  EXPECT_TRUE(handed_out(ranked, false).empty());
  EXPECT_TRUE(handed_out(ranked, true).empty());
  EXPECT_FALSE(ranked.costly());
}

/// Several effects of a joint are together what a function of its motion explains, and none of them
/// explains as much.
TEST(RankedEffects, BesideAFunctionThatExplainsMoreComeAfterTheOthers) {
  SpringsRound round;
  round.add_function(1, 10 * round.screening.named[1].best.score.delta_chi2);
  RankedEffects ranked = round.ranked();
  EXPECT_EQ(handed_out(ranked, false), std::vector<std::size_t>{0});
  const std::optional<RankedEffect> own = ranked.next(true);
  ASSERT_TRUE(own);
  EXPECT_EQ(own->hypothesis, 1U);
  EXPECT_EQ(own->beside, EffectConditions::Beside::kOutdone);
  // of several thousand tests it is no noise, but not beyond doubt
  round.screening.tests = 0.5 * kFalseAlarm * std::exp(round.screening.named[1].surprise);
  RankedEffects doubtful = round.ranked();
  EXPECT_FALSE(doubtful.next(true));
}

TEST(RankedEffects, AreNoWinnersAndNotWithinNoise) {
  SpringsRound round;
  round.result.winners.emplace_back().hypothesis = 1;
  round.screening.tests = std::exp(2 * round.screening.named[0].surprise);
  RankedEffects ranked = round.ranked();
  EXPECT_EQ(ranked.order(), std::vector<std::size_t>{0});
  EXPECT_FALSE(ranked.next(false));
}

TEST(RankedEffects, SayWhatIsNotWorthItsParameters) {
  SpringsRound round;
  NamedResult& spring = round.screening.named[0];
  spring.best.score.delta_chi2 = 1;  // net of a parameter it is less than nothing
  spring.best.few.clear();
  spring.surprise = 50;
  RankedEffects ranked = round.ranked();
  EXPECT_EQ(handed_out(ranked, false), std::vector<std::size_t>{1});
  ASSERT_TRUE(ranked.costly());
  EXPECT_EQ(*ranked.costly(), 0U);
}

}  // namespace
}  // namespace dyngen::runtime
