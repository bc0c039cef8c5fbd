// SPDX-License-Identifier: MIT
#include "tests/blind/score/score.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/blind/score/made_entry.h"

namespace blind {
namespace {

using Json = nlohmann::json;

Json truth(const std::string& kind, const std::vector<std::pair<std::string, int>>& effects) {
  Json truths = Json::array();
  for (const auto& [family, joint] : effects) truths.push_back(made_effect(family, joint, 80));
  return made_entry(kind, truths);
}

Json answer(const Json& findings, const Json& unexplained = Json::array(),
            const Json& undecidable = Json::array()) {
  return {{"schema", "dynid.diagnosis/1"},
          {"findings", findings},
          {"unexplained", unexplained},
          {"undecidable", undecidable},
          {"heldout", {{"rms_before", {2.0, 4.0}}, {"rms_after", {1.0, 2.0}}}}};
}

Json finding(const std::string& family, int joint, double probability,
             const std::vector<std::string>& aliases = {}) {
  return {{"family", family},
          {"joint", joint},
          {"other_joint", nullptr},
          {"aliases", aliases},
          {"probability", probability}};
}

TEST(Score, OfARightNameOnItsJoint) {
  const Judged judged = judge(truth("single", {{"stribeck", 2}}),
                              answer(Json::array({finding("stribeck", 2, 0.97)})));
  EXPECT_TRUE(judged.found && judged.joint && judged.first && judged.among && judged.separable);
  EXPECT_FALSE(judged.confident_wrong || judged.flagged);
  EXPECT_NEAR(judged.heldout, 1, 1e-12);
  EXPECT_NEAR(judged.gap_closed, 1, 1e-12);
}

TEST(Score, OfHeldoutTorqueIsInTheSuitesMeasure) {
  // samples at rest, of which an answer says nothing, make the suite's rms larger
  Json own = truth("single", {{"stribeck", 2}});
  own["heldout_base"] = {4.0, 8.0};
  const Judged judged = judge(own, answer(Json::array({finding("stribeck", 2, 0.97)})));
  EXPECT_NEAR(judged.heldout, 2, 1e-12);  // 1 of 2 of 4, beside the oracle's 1
  EXPECT_NEAR(judged.heldout_before, 4, 1e-12);
  EXPECT_NEAR(judged.gap_closed, 1 - 3.0 / 15, 1e-12);
}

TEST(Score, OfAWrongNameThatIsSureAndOneThatIsNot) {
  const Json two = truth("single", {{"stribeck", 2}});
  EXPECT_TRUE(judge(two, answer(Json::array({finding("cable", 1, 0.95)}))).confident_wrong);
  EXPECT_FALSE(judge(two, answer(Json::array({finding("cable", 1, 0.5)}))).confident_wrong);
  EXPECT_FALSE(judge(two, answer(Json::array({finding("cable", 2, 0.95, {"cable", "stribeck"})})))
                   .confident_wrong);
  EXPECT_FALSE(judge(two, answer(Json::array({finding("cable", 1, 0.95)}))).joint);
}

TEST(Score, OfAnythingInANullIsAFalseAlarm) {
  EXPECT_FALSE(judge(truth("null", {}), answer(Json::array())).found);
  EXPECT_TRUE(judge(truth("null", {}), answer(Json::array({finding("cable", 1, 0.3)}))).found);
  EXPECT_TRUE(
      judge(truth("null", {}), answer(Json::array(), Json::array({Json{{"joint", 1}}}))).found);
}

TEST(Score, OfPairs) {
  const Json two = truth("pair", {{"stribeck", 2}, {"cable", 1}});
  const Judged both =
      judge(two, answer(Json::array({finding("cable", 1, 0.9), finding("stribeck", 2, 0.9)})));
  EXPECT_TRUE(both.both && both.one);
  EXPECT_FALSE(both.third);
  const Judged more =
      judge(two, answer(Json::array({finding("cable", 1, 0.9), finding("stribeck", 1, 0.9),
                                     finding("backlash", 2, 0.4)})));
  EXPECT_FALSE(more.both);
  EXPECT_TRUE(more.one && more.third);
}

TEST(Score, OfWhatIsHiddenAndWhatIsForeign) {
  const Json hidden = truth("hidden", {{"torque_offset", 2}});
  EXPECT_TRUE(
      judge(hidden,
            answer(Json::array(), Json::array(),
                   Json::array({Json{{"families", Json::array({"torque_offset"})}, {"joint", 2}}})))
          .undecidable);
  EXPECT_FALSE(judge(hidden, answer(Json::array())).undecidable);
  const Json foreign = truth("foreign", {{"unknown", 1}});
  EXPECT_TRUE(judge(foreign, answer(Json::array(), Json::array({Json{{"joint", 1}}}))).flagged);
  EXPECT_FALSE(judge(foreign, answer(Json::array({finding("cable", 1, 0.99)}),
                                     Json::array({Json{{"joint", 1}}})))
                   .flagged);
}

TEST(Score, OfNoAnswerIsNothingRight) {
  const Judged judged = judge(truth("single", {{"stribeck", 2}}), Json());
  EXPECT_FALSE(judged.answered || judged.found || judged.first);
  EXPECT_THAT(tables({judged}), testing::HasSubstr("| answered | 0 of 1, 0.0 %"));
}

TEST(Score, StatesTheIntervalsOfClopperAndPearson) {
  const Judged clean = judge(truth("null", {}), answer(Json::array()));
  // 1 - 0.025^(1/20) = 0.1684
  EXPECT_THAT(tables(std::vector<Judged>(20, clean)),
              testing::HasSubstr("| nulls: false alarms | 0 of 20, 0.0 % (0.0 to 16.8) |"));
}

TEST(Score, TellsWhatIsLeftWithoutTheInstantsWhereThatWasMeasured) {
  Judged judged = judge(truth("single", {{"time_delay", 2}}), answer(Json::array()));
  const auto instants = testing::HasSubstr("| lambda without the instants of stops");
  EXPECT_THAT(tables({judged}), testing::Not(instants));
  judged.instants = judged.slow = 15.0;
  EXPECT_THAT(tables({judged}), instants);
  EXPECT_THAT(tables({judged}), testing::HasSubstr("| 10 to 20 | 0 of 1, 0.0 %"));
  // at a level of 2e-7: the tail beyond 5.199 - sqrt(15)
  EXPECT_THAT(tables({judged}),
              testing::HasSubstr("without the instants of stops, turns and letting go | 9.2 % |"));
}

TEST(Score, TellsWhatTheEquationsHoldWhereThatWasMeasured) {
  Judged judged = judge(truth("single", {{"time_delay", 2}}), answer(Json::array()));
  const auto reach = testing::HasSubstr("own equations");
  const auto again = testing::HasSubstr("measured again");
  EXPECT_THAT(tables({judged}), testing::AllOf(testing::Not(reach), testing::Not(again)));
  judged.reach = 15.0;
  EXPECT_THAT(tables({judged}), testing::HasSubstr("in dynid's own equations | 9.2 % |"));
  EXPECT_THAT(tables({judged}), testing::HasSubstr("| lambda in dynid's own equations | found"));
  Judged weak = judged;
  judged.again = 61.0;
  judged.found = true;
  weak.again = 41.0;
  EXPECT_THAT(tables({judged, weak}),
              testing::HasSubstr("when lambda is measured again | 1 of 1, 100.0 % "));
}

TEST(Score, TellsWhatTheEquationsHoldOfForeignPhysics) {
  Judged judged = judge(truth("foreign", {{"unknown", 0}}), answer(Json::array()));
  const auto table = testing::HasSubstr("of it in what repeats");
  EXPECT_THAT(tables({judged}), testing::Not(table));
  judged.reach = 256.3;
  judged.repeating = 164.4;
  EXPECT_THAT(tables({judged}), testing::HasSubstr("| 256 | 164 | clean |"));
}

TEST(Score, SaysWhatWhoKnowsTheFormWouldFindOfTheSame) {
  Judged judged = judge(truth("single", {{"time_delay", 2}}), answer(Json::array()));
  Judged at_rests = judged;
  at_rests.filtered = 0;
  const std::string text = tables({judged, at_rests});
  // the tail beyond 4.056 - sqrt(30): 0.922, and 5e-5 of nothing
  EXPECT_THAT(text, testing::HasSubstr("has what is below 20 Hz, away from rests | 46.1 % |"));
  EXPECT_THAT(
      text, testing::ContainsRegex(
                "\\| 80 \\| 0 of 2, [^|]*\\| 100.0 % \\| 46.1 % \\| 30.5 % \\| not measured \\|"));
}

TEST(Score, SaysWhichBoundsAreBroken) {
  const Json two = truth("single", {{"stribeck", 2}});
  const std::vector<Judged> all = {
      judge(truth("null", {}), answer(Json::array())),
      judge(truth("null", {}), answer(Json::array({finding("cable", 1, 0.3)}))),
      judge(two, answer(Json::array({finding("stribeck", 2, 0.97)}))),
      judge(two, answer(Json::array({finding("cable", 1, 0.95)}))),
      judge(two, answer(Json::array()))};
  EXPECT_EQ(broken(all, {}), "");
  EXPECT_EQ(broken(all, {.most_false_alarms = 0.5,
                         .most_confident_wrong = 0.34,
                         .least_found = 0.66,
                         .least_first = 0.33}),
            "");
  const std::string text = broken(all, {0.4, 0.3, 0.7, 0.4});
  EXPECT_THAT(text, testing::HasSubstr("false alarms of nulls: 0.500, at most 0.4\n"));
  EXPECT_THAT(text, testing::HasSubstr("confident wrong names: 0.333, at most 0.3\n"));
  EXPECT_THAT(text, testing::HasSubstr("single effects found: 0.667, at least 0.7\n"));
  EXPECT_THAT(text, testing::HasSubstr("family first: 0.333, at least 0.4\n"));
  EXPECT_EQ(broken({all[0]}, {0, 0, 1, 1}), "");  // holds neither of the others
}

}  // namespace
}  // namespace blind
