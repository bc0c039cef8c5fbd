// SPDX-License-Identifier: MIT
#include "tests/blind/score/change.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace blind {
namespace {

using Json = nlohmann::json;

// lists as vectors: a list of one JSON value would be that value
Json finding_of(const std::string& family, int joint, const std::vector<std::string>& aliases = {},
                const Json& other = nullptr) {
  return {{"family", family},
          {"joint", joint},
          {"other_joint", other},
          {"aliases", aliases},
          {"probability", 0.9}};
}

Json answer_with(const std::vector<Json>& findings, const std::vector<Json>& unexplained = {}) {
  return {{"schema", "dynid.diagnosis/1"}, {"findings", findings}, {"unexplained", unexplained}};
}

Json entry(const std::string& family, int joint, int other = 0) {
  return {{"case", "c"},
          {"recording", "tx40"},
          {"added",
           {{"family", family},
            {"joint", joint},
            {"other_joint", other},
            {"form", "f"},
            {"strength", 300.0},
            {"absorbed", 0.4}}}};
}

TEST(Change, IsRightWhereItAppearsAndNothingElse) {
  const Json plain = answer_with({finding_of("cable", 1)});
  const Change one = judge_change(
      entry("stribeck", 2), plain,
      answer_with({finding_of("cable", 1), finding_of("presliding", 2, {"stribeck"})}));
  EXPECT_TRUE(one.right());
  EXPECT_FALSE(one.first);
  EXPECT_EQ(one.said, "presliding 2");
  EXPECT_TRUE(one.lost.empty());
}

TEST(Change, IsNotRightOnAnotherJointOrWithAnotherName) {
  const Json plain = answer_with({finding_of("cable", 1)});
  const Change one =
      judge_change(entry("stribeck", 2), plain, answer_with({finding_of("stribeck", 1)}));
  EXPECT_FALSE(one.appears || one.right());
  EXPECT_THAT(one.more, testing::ElementsAre("stribeck 1"));
  EXPECT_THAT(one.lost, testing::ElementsAre("cable 1"));
  const Change two = judge_change(
      entry("stribeck", 2), plain,
      answer_with({finding_of("cable", 1), finding_of("stribeck", 2), finding_of("backlash", 2)}));
  EXPECT_TRUE(two.appears && two.first);
  EXPECT_FALSE(two.right());
}

TEST(Change, DoesNotCountWhatWasSaidBefore) {
  const Json plain =
      answer_with({finding_of("nonlinear_viscous", 2, {"nonlinear_viscous", "stribeck"})});
  const Change one =
      judge_change(entry("stribeck", 2), plain, answer_with({finding_of("stribeck", 2)}));
  EXPECT_TRUE(one.before);
  EXPECT_FALSE(one.right());
  EXPECT_TRUE(one.lost.empty());  // the same joint, and a name of its own
  EXPECT_THAT(change_table({one}), testing::HasSubstr("Right: 0 of 0"));
}

TEST(Change, KnowsPairsEitherWayAndTheWholeRobot) {
  const Json plain = answer_with({finding_of("joint_coupling", 5, {}, 6)});
  const Change pair = judge_change(entry("joint_coupling", 2, 3), plain,
                                   answer_with({finding_of("joint_coupling", 6, {}, 5),
                                                finding_of("joint_coupling", 3, {}, 2)}));
  EXPECT_TRUE(pair.right());
  EXPECT_EQ(pair.said, "joint_coupling 3-2");
  EXPECT_TRUE(judge_change(entry("payload_change", 0), plain,
                           answer_with({finding_of("joint_coupling", 5, {}, 6),
                                        finding_of("payload_change", 6)}))
                  .right());
}

TEST(Change, ListsWhatIsNewlyWithoutAName) {
  const Change one = judge_change(entry("stribeck", 2), answer_with({}, {Json{{"joint", 1}}}),
                                  answer_with({}, {Json{{"joint", 1}}, Json{{"joint", 2}}}));
  EXPECT_THAT(one.open, testing::ElementsAre("joint 2"));
  EXPECT_THAT(
      change_table({one}),
      testing::HasSubstr("| tx40 | stribeck 2: f | 300, 40 % | - | - | - | joint 2 | missed"));
  EXPECT_FALSE(judge_change(entry("stribeck", 2), Json(), answer_with({})).answered);
}

}  // namespace
}  // namespace blind
