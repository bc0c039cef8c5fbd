// SPDX-License-Identifier: MIT
// Intervals, the oracle's curve, numbers of findings, second answers, and what pictures show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/blind/score/estimates.h"
#include "tests/blind/score/figures.h"
#include "tests/blind/score/made_entry.h"
#include "tests/blind/score/second.h"
#include "tests/blind/score/shares.h"

namespace blind {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

Json truth_of(const std::string& family, int joint, double lambda) {
  Json truth = made_effect(family, joint, lambda);
  truth["absorbed"] = 0.75;
  truth["own_form"] = false;
  return truth;
}

Json entry(const std::string& kind, const Json& truths) {
  Json made = made_entry(kind, truths);
  made["excess"] = 0.004;
  made["heldout_oracle"] = {1.0, 1.0};
  return made;
}

Json finding(const std::string& family, int joint, const std::vector<std::string>& aliases,
             const Json& parameters = Json::object(), const std::string& formula = "") {
  return {{"family", family},   {"joint", joint},      {"other_joint", nullptr},
          {"aliases", aliases}, {"probability", 0.95}, {"parameters", parameters},
          {"formula", formula}};
}

Json stored_answer(const Json& findings) {
  return {{"schema", "dynid.diagnosis/1"},
          {"findings", findings},
          {"unexplained", Json::array()},
          {"undecidable", Json::array()},
          {"heldout", {{"rms_before", {2.0, 2.0}}, {"rms_after", {1.1, 1.1}}}}};
}

Judged one(const Json& truth, const Json& found, const std::string& kind = "single") {
  return judge(entry(kind, Json::array({truth})), stored_answer(Json::array({found})));
}

TEST(Oracle, HasTheLevelAtNothingAndRises) {
  EXPECT_NEAR(oracle_power(0, 1), 0.01 / 200, 1e-12);
  EXPECT_NEAR(oracle_power(0, 1, 0.3), 0.3, 1e-12);
  EXPECT_NEAR(oracle_power(5.199 * 5.199, 1, kDiagnosisLevel), 0.5, 1e-3);
  EXPECT_NEAR(oracle_power(1e-9, 3), 0.01 / 200, 1e-8);
  for (const int degrees : {1, 2, 4}) {
    for (double lambda = 1; lambda < 200; lambda *= 1.3) {
      EXPECT_GT(oracle_power(1.3 * lambda, degrees), oracle_power(lambda, degrees) - 1e-12);
    }
  }
  EXPECT_GT(oracle_power(20, 1), oracle_power(20, 2));
}

// Of one degree the statistic is a normal number's square: z = 4.0556 cuts off 2.5e-5 on each side.
TEST(Oracle, OfOneDegreeIsTheNormalDistributions) {
  const auto upper = [](double z) { return std::erfc(z / std::sqrt(2.0)) / 2; };
  const double z = 4.055627;
  ASSERT_NEAR(2 * upper(z), 0.01 / 200, 1e-10);
  for (const double lambda : {4.0, 16.0, 40.0}) {
    const double root = std::sqrt(lambda);
    EXPECT_NEAR(oracle_power(lambda, 1), upper(z - root) + upper(z + root), 1e-5) << lambda;
  }
}

TEST(Oracle, NeedsWhatIsKnownForHalfAndForNineTenths) {
  EXPECT_NEAR(oracle_lambda(0.5, 1), 16.4, 0.1);
  EXPECT_NEAR(oracle_lambda(0.9, 1), 28.5, 0.1);
  EXPECT_NEAR(oracle_power(oracle_lambda(0.9, 4), 4), 0.9, 1e-9);
}

TEST(Shares, HaveTheirIntervals) {
  EXPECT_EQ(text_of(share_of(0, 20)), "0 of 20, 0.0 % (0.0 to 16.8)");
  EXPECT_EQ(text_of(share_of(20, 20)), "20 of 20, 100.0 % (83.2 to 100.0)");
  EXPECT_EQ(text_of(share_of(0, 0)), "none");
}

TEST(Shares, CrossHalfBetweenSteps) {
  const double half = half_detected({{10, share_of(0, 10)}, {40, share_of(10, 10)}});
  EXPECT_NEAR(half, 20, 1e-9);  // in the middle of the logarithms
  // the second step falls by chance: it is pooled with the first
  EXPECT_NEAR(half_detected({{5, share_of(3, 10)}, {10, share_of(1, 10)}, {40, share_of(8, 10)}}),
              10 * std::pow(4, 0.5), 1e-9);
  EXPECT_TRUE(std::isnan(half_detected({{10, share_of(9, 10)}, {40, share_of(10, 10)}})));
  EXPECT_TRUE(std::isnan(half_detected({{10, share_of(0, 10)}, {40, share_of(4, 10)}})));
}

TEST(Estimates, OfTheSameNumberAreHeldAgainstTheTruth) {
  Json truth = truth_of("load_friction", 2, 120);
  truth["parameters"] = {{"mu", 0.05}};
  const Json mu = {{"mu", {{"value", 0.06}, {"std", 0.004}, {"unit", "1"}}}};
  const auto found = estimates({one(truth, finding("load_friction", 2, {"load_friction"}, mu))});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].error(), 0.2, 1e-12);
  EXPECT_FALSE(found[0].covered());  // 2.5 deviations away
  const Json wide = {{"mu", {{"value", 0.06}, {"std", 0.006}, {"unit", "1"}}}};
  EXPECT_TRUE(
      estimates({one(truth, finding("load_friction", 2, {"load_friction"}, wide))})[0].covered());
  EXPECT_TRUE(estimates({one(truth, finding("load_friction", 1, {"load_friction"}, mu))}).empty());
  EXPECT_TRUE(estimates({one(truth, finding("cable", 2, {"cable"}, mu))}).empty());
}

TEST(Estimates, OfAnotherMemberOfTheFamilyAreNone) {
  Json truth = truth_of("load_friction", 2, 120);
  truth["parameters"] = {{"mu", 0.05}};
  const Json stribeck = {{"mu", {{"value", 0.06}, {"std", 0.004}}},
                         {"vs", {{"value", 0.1}, {"std", 0.01}}}};
  EXPECT_TRUE(
      estimates({one(truth, finding("load_friction", 2, {"load_friction"}, stribeck))}).empty());
  Json length = truth_of("geometry_error", 2, 120);
  length["parameters"] = {{"error", 0.01}};
  length["formula"] = "error*d_d";
  const Json error = {{"error", {{"value", 0.011}, {"std", 0.001}}}};
  EXPECT_EQ(estimates({one(length, finding("geometry_error", 2, {}, error, "error*d_d"))}).size(),
            1U);
  EXPECT_TRUE(
      estimates({one(length, finding("geometry_error", 2, {}, error, "error*d_theta"))}).empty());
}

TEST(Estimates, CountIntervalsOnlyWhereTheFindingStatesOne) {
  Json truth = truth_of("joint_coupling", 1, 120);
  truth["parameters"] = {{"F", 1.0}, {"ratio", 1.0}};
  const Json numbers = {{"F", {{"value", 1.1}, {"std", 0.1}}},
                        {"ratio", {{"value", 1.0}, {"std", nullptr}}}};
  const std::string table = estimate_table({one(truth, finding("joint_coupling", 1, {}, numbers))});
  EXPECT_THAT(table, HasSubstr("lambda of 100 and more, median | 5.0 %, of 2 |"));
  EXPECT_THAT(table, HasSubstr("the catalogue's form | 1 of 1, 100.0 %"));
  EXPECT_THAT(table, HasSubstr("another form | none |"));
}

const Json kAsked = {
    {"found", true}, {"separation", 40.0}, {"trajectory", {{"period", 10.0}, {"periods", 5}}}};

Second after(const Json& truths, const Json& findings, const std::string& kind = "single") {
  const Json open =
      stored_answer(Json::array({finding("stribeck", 2, {"stribeck", "presliding"})}));
  const Judged judged = judge(entry(kind, truths), open);
  EXPECT_TRUE(leaves_names(judged.answer));
  return judge_second(judged, findings.is_null() ? Json() : stored_answer(findings), kAsked);
}

TEST(Second, ResolvesToTheTruthOrNot) {
  using Outcome = Second::Outcome;
  const Json truths = Json::array({truth_of("presliding", 2, 80)});
  const Second right = after(truths, Json::array({finding("presliding", 2, {"presliding"})}));
  EXPECT_EQ(right.outcome, Outcome::kRight);
  EXPECT_TRUE(right.held);
  EXPECT_EQ(right.duration, 50);
  EXPECT_EQ(after(truths, Json::array({finding("stribeck", 2, {"stribeck"})})).outcome,
            Outcome::kWrong);
  EXPECT_EQ(
      after(truths, Json::array({finding("stribeck", 2, {"stribeck", "presliding"})})).outcome,
      Outcome::kOpen);
  EXPECT_EQ(after(truths, Json::array()).outcome, Outcome::kLost);
  EXPECT_EQ(after(truths, Json()).outcome, Outcome::kNotAsked);
  // a finding of another joint is not what became of the names
  EXPECT_EQ(after(truths, Json::array({finding("cable", 1, {"cable"})})).outcome, Outcome::kLost);
}

TEST(Second, LooksForTheTruthAmongSeveralFindings) {
  const Json truths = Json::array({truth_of("presliding", 2, 80)});
  const Json two =
      Json::array({finding("cable", 1, {"cable"}), finding("presliding", 2, {"presliding"})});
  EXPECT_EQ(after(truths, two).outcome, Second::Outcome::kRight);
  EXPECT_TRUE(after(truths, two).too_many);
  EXPECT_FALSE(after(truths, Json::array({two[1]})).too_many);
}

/// Two truths whose families are both among the names: the one of the joint is meant.
TEST(Second, IsAboutTheTruthOfItsJoint) {
  const Json truths = Json::array({truth_of("stribeck", 1, 80), truth_of("presliding", 2, 80)});
  EXPECT_EQ(after(truths, Json::array({finding("presliding", 2, {"presliding"})}), "pair").outcome,
            Second::Outcome::kRight);
  EXPECT_EQ(after(truths, Json::array({finding("cable", 2, {"cable"})}), "pair").outcome,
            Second::Outcome::kWrong);
}

/// All truths have their names: a set beside them is about nothing.
TEST(Second, IsAboutNothingBesideWhatIsNamed) {
  const Json truths = Json::array({truth_of("base_tilt", 0, 300)});
  const Json tilt = finding("base_tilt", 0, {"base_tilt"}),
             names = finding("stribeck", 2, {"stribeck", "presliding"});
  const Judged judged = judge(entry("single", truths), stored_answer(Json::array({tilt, names})));
  const auto then = [&](const Json& findings) {
    return judge_second(judged, stored_answer(findings), kAsked);
  };
  EXPECT_FALSE(then(Json::array({tilt})).nameable);
  EXPECT_EQ(then(Json::array({tilt, names})).outcome, Second::Outcome::kOpen);
}

TEST(Second, WithdrawsWhatIsNotThere) {
  using Outcome = Second::Outcome;
  EXPECT_EQ(after(Json::array(), Json::array(), "null").outcome, Outcome::kRight);
  const Second named =
      after(Json::array(), Json::array({finding("stribeck", 2, {"stribeck"})}), "null");
  EXPECT_EQ(named.outcome, Outcome::kWrong);
  EXPECT_FALSE(named.nameable);
  const Json foreign = Json::array({truth_of("unknown", 2, 80)});
  EXPECT_EQ(after(foreign, Json::array(), "foreign").outcome, Outcome::kRight);
}

TEST(Second, IsTold) {
  const Json truths = Json::array({truth_of("presliding", 2, 80)});
  const std::vector<Second> all = {
      after(truths, Json::array({finding("presliding", 2, {"presliding"})})),
      after(truths, Json::array({finding("stribeck", 2, {"stribeck"})})),
      after(Json::array(), Json::array(), "null")};
  const std::string table = second_table(all);
  EXPECT_THAT(table, HasSubstr("| sets of names, resolved to the truth | 1 of 2, 50.0 %"));
  EXPECT_THAT(table, HasSubstr("| resolved to a wrong name | 1 of 2"));
  EXPECT_THAT(table, HasSubstr("| sets where no name is right, withdrawn | 1 of 1"));
  EXPECT_THAT(table, HasSubstr("| 50, 50, 50 s |"));
  EXPECT_THAT(second_lines(all), HasSubstr("c: stribeck or presliding -> presliding (right;"));
}

TEST(Figures, ShowWhatWasCounted) {
  const Json truth = truth_of("stribeck", 2, 90);
  const Judged right = one(truth, finding("stribeck", 2, {"stribeck"}));
  const Judged missed = judge(entry("single", Json::array({truth})), stored_answer(Json::array()));
  const Judged null = judge(entry("null", Json::array()), stored_answer(Json::array()));
  const auto files = figures({right, missed, null});
  EXPECT_THAT(files.at("detection.csv"), HasSubstr("\n90,2,0.5000,0.0126,0.9874,0.5000,"));
  EXPECT_EQ(files.at("confusion.csv"),
            "truth,stribeck,without a name,clean,no answer\n"
            "stribeck,1,0,1,0\n"
            "nothing,0,0,1,0\n");
  EXPECT_EQ(files.at("heldout.csv"), "share,before,after\n1.0000,2.00000,1.10000\n");
  EXPECT_EQ(files.at("concealed.csv"),
            "absorbed,excess,lambda\n0.7500,0.004000,90.000\n0.7500,0.004000,90.000\n");
  EXPECT_THAT(files.at("oracle.csv"), HasSubstr("lambda,one,two,four,asked\n2,"));
  EXPECT_EQ(figures({null}).count("detection.csv"), 0U);
}

}  // namespace
}  // namespace blind
