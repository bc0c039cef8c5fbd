// SPDX-License-Identifier: MIT
#include "tests/blind/score/baselines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace blind {
namespace {

using Json = nlohmann::json;

Json single() {
  return {{"case", "c"},
          {"kind", "single"},
          {"excess", 0.001},
          {"filtered", 30.0},
          {"imitated", Json::object()},
          {"heldout_oracle", {1.0, 2.0}},
          {"truths", Json::array({Json{{"family", "stribeck"},
                                       {"joint", 2},
                                       {"other_joint", 0},
                                       {"lambda", 80.0},
                                       {"absorbed", 0.5}}})}};
}

Json null() {
  Json entry = single();
  entry["kind"] = "null";
  entry["truths"] = Json::array();
  return entry;
}

Json name(const std::string& family, int joint) { return {{"family", family}, {"joint", joint}}; }

Json answer(const std::string& baseline, const Json& names) {
  const Json one = {{"baseline", baseline}, {"names", names}, {"heldout_rms", {1.1, 2.2}}};
  return {{"schema", "blind.baselines/1"}, {"baselines", Json::array({one})}};
}

TEST(BaselineScore, CountsNamesRightAndWrong) {
  const auto judged = judge_baselines(
      single(),
      answer("lasso", Json::array({name("cable", 1), name("stribeck", 2), name("stribeck", 1)})));
  ASSERT_EQ(judged.size(), 1U);
  EXPECT_TRUE(judged[0].said && judged[0].among && judged[0].names);
  EXPECT_FALSE(judged[0].first);
  EXPECT_EQ(judged[0].count, 3);
  EXPECT_EQ(judged[0].wrong, 1);
  EXPECT_NEAR(judged[0].heldout, 1.1, 1e-12);
  EXPECT_TRUE(
      judge_baselines(single(), answer("lasso", Json::array({name("stribeck", 2)})))[0].first);
  EXPECT_FALSE(
      judge_baselines(single(), answer("lasso", Json::array({name("stribeck", 1)})))[0].first);
}

TEST(BaselineScore, EveryNameOfANullIsWrong) {
  const auto judged = judge_baselines(null(), answer("ladder", Json::array({name("cable", 1)})));
  EXPECT_TRUE(judged[0].said);
  EXPECT_EQ(judged[0].wrong, 1);
  EXPECT_TRUE(judge_baselines(null(), Json()).empty());
}

TEST(BaselineScore, PutsADiagnosisInTheSameTerms) {
  const Json finding = {{"family", "presliding"},
                        {"joint", 2},
                        {"other_joint", nullptr},
                        {"aliases", {"presliding", "stribeck"}},
                        {"probability", 0.6}};
  const Json said = {{"schema", "dynid.diagnosis/1"},
                     {"findings", Json::array({finding})},
                     {"unexplained", Json::array()},
                     {"undecidable", Json::array()},
                     {"heldout", {{"rms_before", {2.0, 4.0}}, {"rms_after", {1.0, 2.0}}}}};
  const JudgedBaseline one = as_baseline(judge(single(), said));
  EXPECT_TRUE(one.said);
  EXPECT_FALSE(one.first || one.among);
  EXPECT_EQ(one.count, 1);
  EXPECT_EQ(one.wrong, 0);  // the truth is an alias
  EXPECT_EQ(as_baseline(judge(null(), said)).wrong, 1);
  EXPECT_NEAR(one.heldout, 1, 1e-12);
}

TEST(BaselineScore, WritesARowForEachMethod) {
  std::vector<JudgedBaseline> all;
  for (const Json& answered :
       {answer("lasso", Json::array({name("cable", 1)})), answer("spline", Json::array())}) {
    for (const Json& truth : {null(), single()}) {
      for (const auto& one : judge_baselines(truth, answered)) all.push_back(one);
    }
  }
  const std::string text = baseline_table(all);
  EXPECT_THAT(text, testing::HasSubstr("| lasso | 1 of 1 | 1 of 1 | 0 of 1 | 0 of 1 | 1.0 | 1.0 | "
                                       "1.100, 1.100 | 1.100, 1.100 |\n"));
  EXPECT_THAT(text, testing::HasSubstr(
                        "| spline | names nothing | | | | | | 1.100, 1.100 | 1.100, 1.100 |"));
}

}  // namespace
}  // namespace blind
