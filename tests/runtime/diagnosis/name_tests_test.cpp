// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/name_tests.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "runtime/effects/absorption.h"
#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

constexpr double kNameNoise = 0.1;  // N m

/// A torque a |q| q of joint 2, which no parameter of the arm has, where a condition holds.
EffectLaw cubic(const std::function<bool(const VectorXd&)>& where) {
  return test::algebraic_law("cubic", {"q", "qd", "tau_load"},
                             {{"a", EffectRole::kLinear, -10, 10, 0, 1}},
                             [where](const VectorXd& v, const VectorXd& p) {
                               return where(v) ? p[0] * std::abs(v[0]) * v[0] : 0;
                             });
}

bool always(const VectorXd&) { return true; }

/// Tests of the cubic law at size 0.5, on recordings that hold another torque.
std::vector<FalsifierOutcome> outcomes(const EffectLaw& truth,
                                       const std::vector<std::string>& tests, unsigned seed) {
  const EffectRecordings data =
      effect_recordings(test::planar_arm(), test::planar_arm_tangents(),
                        test::measured({test::sines(40, 0.01)}, test::planar_arm_values(),
                                       {test::known(truth, 1, {0.5})}, kNameNoise, 0, seed),
                        {1, -1}, {true, true});
  const TorqueNoiseModel noise{quick_noise(white_noise(VectorXd::Constant(2, kNameNoise)).joints),
                               VectorXd::Constant(2, 4000), false, VectorXd::Ones(2)};
  const EvidenceSystem system(data, {residual(data.runs.front().rows, test::planar_arm_values())},
                              noise, {});
  EffectSignals signals(data);
  signals.set_beta(test::planar_arm_values());
  EffectInstance effect = test::known(cubic(always), 1, {0.5});
  effect.law.tests = tests;
  return name_tests(data, signals, system, effect);
}

const std::vector<std::string> kSplits = {"both_directions", "speed_independent", "two_loads",
                                          "monotone",        "slow_steady",       "load_reversal",
                                          "partner_alone",   "distance_collapse"};

TEST(NameTests, OfTheTruthPass) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const std::vector<FalsifierOutcome> results = outcomes(cubic(always), kSplits, seed);
    ASSERT_EQ(results.size(), kSplits.size());
    for (std::size_t i = 0; i < results.size(); ++i) {
      EXPECT_EQ(results[i].test, kSplits[i]);
      EXPECT_TRUE(results[i].known) << results[i].test << ": " << results[i].text;
      EXPECT_TRUE(results[i].passed) << results[i].test << ": " << results[i].text;
    }
  }
}

/// What acts in one direction alone, or fast alone, is not the effect that acts always.
TEST(NameTests, FailWhereASizeDoesNotHold) {
  const auto forwards = cubic([](const VectorXd& v) { return v[1] > 0; });
  EXPECT_FALSE(outcomes(forwards, {"both_directions"}, 1).front().passed);
  const auto fast = cubic([](const VectorXd& v) { return std::abs(v[1]) > 1; });
  EXPECT_FALSE(outcomes(fast, {"speed_independent"}, 1).front().passed);
  const FalsifierOutcome slow = outcomes(fast, {"slow_steady"}, 1).front();
  EXPECT_TRUE(slow.known && !slow.passed) << slow.text;
}

TEST(NameTests, SayWhatTheyNeed) {
  const std::vector<FalsifierOutcome> results =
      outcomes(cubic(always), {"order_match", "rest_resets", "all_joints"}, 1);
  ASSERT_EQ(results.size(), 3u);
  for (const FalsifierOutcome& result : results) {
    EXPECT_FALSE(result.known) << result.test;
    EXPECT_FALSE(result.text.empty());
  }
  EXPECT_NE(results[1].text.find("another recording"), std::string::npos);
}

}  // namespace
}  // namespace dyngen::runtime
