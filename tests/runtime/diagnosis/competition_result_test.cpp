// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/competition_result.h"

#include <gtest/gtest.h>

#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

enum Place : std::size_t { kPush, kDrift, kSpring };

/// An event, what changes with time, and what does neither.
std::vector<Hypothesis> push_drift_and_spring() {
  const EffectLaw drift = test::algebraic_law(
      "drift", {"t"}, {{"rate", EffectRole::kLinear, -1, 1, 0, 0.1}},
      [](const Eigen::VectorXd& v, const Eigen::VectorXd& p) { return p[0] * v[0]; });
  std::vector<Hypothesis> all(3);
  all[kPush].effect = test::unknown(drift, 0);
  all[kPush].windowed = true;
  all[kDrift].effect = test::unknown(drift, 0);
  all[kSpring].effect = test::unknown(test::spring_law(), 0);
  return all;
}

CompetitionResult with_winner(std::size_t place) {
  CompetitionResult result;
  result.winners.emplace_back().hypothesis = place;
  return result;
}

TEST(MayBeRemnant, IsAnEventBesideWhatChangesWithTime) {
  const std::vector<Hypothesis> all = push_drift_and_spring();
  EXPECT_TRUE(may_be_remnant(with_winner(kDrift), all, kPush));
  EXPECT_FALSE(may_be_remnant({}, all, kPush));
  EXPECT_FALSE(may_be_remnant(with_winner(kSpring), all, kPush));
  // an event reads the time too, and has an end
  EXPECT_FALSE(may_be_remnant(with_winner(kPush), all, kPush));
}

/// Two forces on links, with the first found from 10 s to 12 s of the second recording.
TEST(IsPartOfFoundEvent, IsWhatOverlapsItInItsRecording) {
  std::vector<Hypothesis> all(3);
  for (const std::size_t place : {0U, 1U, 2U}) {
    all[place].effect = test::unknown(test::contact_law(), place == 0 ? 0 : 1);
    all[place].shapes = {3, 4};
    all[place].windowed = true;
  }
  all[2].effect.law.family = "payload_change";
  CompetitionResult result = with_winner(0);
  result.fit.point.effects = {test::known(test::contact_law(), 0, {0, 0, 1, 10, 12})};
  result.fit.point.effects[0].recording = 1;
  const auto is_part = [&](double begin, double end, int recording, std::size_t place = 1) {
    EffectInstance event = test::known(test::contact_law(), 1, {0, 0, 1, begin, end});
    event.recording = recording;
    return is_part_of_found_event(result, all, place, event);
  };
  EXPECT_TRUE(is_part(11, 13, 1));
  EXPECT_TRUE(is_part(9, 10.5, -1));
  EXPECT_FALSE(is_part(12, 13, 1));
  EXPECT_FALSE(is_part(11, 13, 0));
  EXPECT_FALSE(is_part(11, 13, 1, 2));
  result.winners.clear();
  EXPECT_FALSE(is_part(11, 13, 1));
}

TEST(MayBeRemnant, IsAnEventBesideStructureWithoutAName) {
  const std::vector<Hypothesis> all = push_drift_and_spring();
  CompetitionResult result = with_winner(kSpring);
  result.nameless.emplace_back();
  EXPECT_TRUE(may_be_remnant(result, all, kPush));
}

TEST(MayBeRemnant, IsNothingThatActsAlways) {
  const std::vector<Hypothesis> all = push_drift_and_spring();
  CompetitionResult result = with_winner(kDrift);
  result.nameless.emplace_back();
  EXPECT_FALSE(may_be_remnant(result, all, kSpring));
  EXPECT_FALSE(may_be_remnant(result, all, kDrift));
}

}  // namespace
}  // namespace dyngen::runtime
