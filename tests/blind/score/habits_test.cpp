// SPDX-License-Identifier: MIT
#include "tests/blind/score/habits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/blind/score/made_entry.h"

namespace blind {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

Json said(const std::string& family, int joint, std::vector<std::string> aliases = {}) {
  return {{"family", family},
          {"joint", joint},
          {"other_joint", nullptr},
          {"aliases", std::move(aliases)},
          {"probability", 0.95}};
}

Judged judged_case(const std::string& kind, const std::string& habit, const Json& truths,
                   const Json& findings, const Json& allowed = Json::array()) {
  Json truth = made_entry(kind, truths);
  truth["habit"] = habit;
  truth["allowed"] = allowed;
  const Json answer = {{"schema", "dynid.diagnosis/1"},
                       {"findings", findings},
                       {"unexplained", Json::array()},
                       {"undecidable", Json::array()},
                       {"heldout", {{"rms_before", {3.0, 6.0}}, {"rms_after", {2.0, 4.0}}}}};
  return judge(truth, answer);
}

TEST(Habits, MakeSomeFindingsRight) {
  const Json late = Json::array({said("time_delay", 1)});
  const Json allowed = Json::array({"time_delay", "actuator_lag"});
  const Judged excused = judged_case("null", "late_columns", Json::array(), late, allowed);
  EXPECT_FALSE(excused.found || excused.confident_wrong);
  EXPECT_EQ(excused.excused.size(), 1U);
  EXPECT_THAT(lines({excused}),
              HasSubstr("late_columns planar2 PD: nothing -> (time_delay of joint 1, excused)"));
  EXPECT_TRUE(judged_case("null", "laboratory", Json::array(), late).found);
  const Judged more = judged_case("null", "late_columns", Json::array(),
                                  Json::array({said("time_delay", 1), said("cable", 2)}), allowed);
  EXPECT_TRUE(more.found && more.confident_wrong);
}

TEST(Habits, DoNotHideATruthOfTheirFamily) {
  const Json late = Json::array({said("time_delay", 1)});
  const Json allowed = Json::array({"time_delay"});
  const Judged right = judged_case("single", "late_columns",
                                   Json::array({made_effect("time_delay", 1, 80)}), late, allowed);
  EXPECT_TRUE(right.found && right.first);
  const Judged missed = judged_case("single", "late_columns",
                                    Json::array({made_effect("cable", 1, 80)}), late, allowed);
  EXPECT_FALSE(missed.found || missed.confident_wrong);
}

TEST(Habits, HaveARowEach) {
  const std::vector<Judged> all = {
      judged_case("null", "laboratory", Json::array(), Json::array()),
      judged_case("null", "chirps", Json::array(), Json::array({said("cable", 1)})),
      judged_case("single", "chirps", Json::array({made_effect("cable", 1, 80)}),
                  Json::array({said("cable", 1)}))};
  const std::string text = habit_table(all);
  EXPECT_THAT(text, HasSubstr("| laboratory | 0 of 1, 0.0 % (0.0 to 97.5) | none | none | none |"));
  EXPECT_THAT(text, HasSubstr("| chirps | 1 of 1, 100.0 % (2.5 to 100.0) | 1 of 1, 100.0 % (2.5 to "
                              "100.0) | 1 of 1, 100.0 % (2.5 to 100.0) | 0 of 1, 0.0 %"));
  EXPECT_EQ(habit_table({all[0]}), "");
  EXPECT_THAT(tables(all), HasSubstr(text));
}

TEST(Crowds, AreCountedByFamilyAndJoint) {
  const Json truths =
      Json::array({made_effect("stribeck", 1, 900), made_effect("stribeck", 2, 300),
                   made_effect("cable", 1, 250), made_effect("torque_ripple", 2, 150)});
  const Json findings =
      Json::array({said("stribeck", 1), said("presliding", 2, {"presliding", "stribeck"}),
                   said("torque_ripple", 2), said("cable", 2)});
  const CrowdCount count = count_crowds({judged_case("crowd", "laboratory", truths, findings)});
  EXPECT_EQ(count.strong, 3);
  EXPECT_EQ(count.named, 1);  // stribeck of joint 1
  EXPECT_EQ(count.among, 2);  // and of joint 2 among names
  EXPECT_EQ(count.findings, 4);
  EXPECT_EQ(count.right, 2);     // the ripple is right, though it is weak
  EXPECT_EQ(count.spurious, 1);  // the cable on the wrong joint
  EXPECT_NEAR(count.gap_closed, 1 - 3.0 / 8, 1e-12);
}

TEST(Crowds, TakeEachEffectOnce) {
  const Json truths = Json::array({made_effect("stribeck", 1, 900)});
  const Json findings = Json::array({said("stribeck", 1), said("stribeck", 1)});
  const std::vector<Judged> all = {judged_case("crowd", "laboratory", truths, findings)};
  EXPECT_EQ(count_crowds(all).right, 1);
  EXPECT_EQ(count_crowds(all).spurious, 1);
  EXPECT_THAT(crowd_table(all), HasSubstr("| precision: family and joint first, of all findings | "
                                          "1 of 2, 50.0 %"));
  EXPECT_EQ(crowd_table({}), "");
}

TEST(Crowds, WithoutAnAnswerAreMissed) {
  Judged none = judged_case("crowd", "laboratory", Json::array({made_effect("stribeck", 1, 900)}),
                            Json::array());
  none.answered = false;
  const CrowdCount count = count_crowds({none});
  EXPECT_EQ(count.strong, 1);
  EXPECT_EQ(count.named + count.findings, 0);
}

}  // namespace
}  // namespace blind
