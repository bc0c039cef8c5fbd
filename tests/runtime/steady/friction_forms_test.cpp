// SPDX-License-Identifier: MIT
#include "runtime/steady/friction_forms.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>

#include "runtime/steady/friction_curve.h"
#include "tests/runtime/steady/made_steady.h"

namespace dyngen::runtime {
namespace {

double sign(double v) { return v > 0 ? 1 : -1; }

double plain(double v) { return 3 * sign(v) + 4 * v; }
double stribeck(double v) { return plain(v) + 1.2 * std::exp(-v * v / 0.01) * sign(v); }
double concave(double v) { return 2 * sign(v) + 6 * std::pow(std::abs(v), 0.5) * sign(v); }
double asymmetric(double v) { return plain(v) + 0.8 * std::abs(v); }

/// How often each form was chosen, and how often the intervals of the true form hold.
struct Counts {
  int all = 0;
  std::array<int, 1U << kFrictionTerms> chosen{};
  int held = 0, numbers = 0;

  [[nodiscard]] int with(FrictionTerm term) const {
    int count = 0;
    for (unsigned bits = 0; bits < chosen.size(); ++bits) {
      if (FrictionTerms{bits}.has(term)) count += chosen[bits];
    }
    return count;
  }
};

Counts count_forms(const std::function<double(double)>& friction, const test::MadeNoise& noise,
                   unsigned simulations, FrictionTerms truth,
                   const std::map<std::string, double>& values, bool in_turn = false) {
  Counts counts;
  for (unsigned seed = 0; seed < simulations; ++seed) {
    test::MadeJoint joint;
    joint.friction = friction;
    joint.noise = noise;
    if (in_turn) joint.speeds = {0.02, 2, 0.034, 1.2, 0.056, 0.72, 0.093, 0.43, 0.155, 0.26};
    const SteadyResult result =
        analyse_steady({{test::made_recording(joint, seed)}, 0, true, {}}, SteadyRules());
    EXPECT_TRUE(result.forms.judged) << result.forms.why_not;
    if (!result.forms.judged) continue;
    ++counts.all;
    ++counts.chosen[result.forms.chosen.bits];
    if (!(result.forms.chosen == truth)) continue;
    for (const FrictionNumber& own : result.forms.numbers) {
      const auto value = values.find(own.name);
      if (value == values.end()) continue;
      counts.held += own.low <= value->second && value->second <= own.high;
      ++counts.numbers;
    }
  }
  return counts;
}

void print(const char* what, const Counts& counts) {
  std::cout << what << ", seeds 0 to " << counts.all - 1 << ":";
  for (unsigned bits = 0; bits < counts.chosen.size(); ++bits) {
    if (counts.chosen[bits] > 0) {
      std::cout << " " << words_of({bits}) << " " << counts.chosen[bits] << ";";
    }
  }
  std::cout << " intervals that hold: " << counts.held << " of " << counts.numbers << "\n";
}

const FrictionTerms kPlain;
const test::MadeNoise kSlow;  // white, and a part that is forgotten in 0.3 s

TEST(FrictionForms, CoulombAndViscousFrictionIsNothingElse) {
  const Counts slow = count_forms(plain, kSlow, 200, kPlain, {{"Fc", 3}, {"Fv", 4}});
  print("Coulomb and viscous, AR(1)", slow);
  // the chance of a false term is 0.001 each: 0.2 of 200 are expected, 2 or more are of 1 in 60
  EXPECT_LE(slow.with(FrictionTerm::kStribeck), 1);
  EXPECT_LE(slow.all - slow.chosen[0], 2);
  EXPECT_GE(slow.held, 0.92 * slow.numbers);
}

TEST(FrictionForms, NoiseLikeOneOverFIsNoStribeckCurve) {
  const std::map<std::string, double> values = {{"Fc", 3}, {"Fv", 4}};
  const Counts in_turn = count_forms(plain, test::pink_noise(), 200, kPlain, values, true);
  print("Coulomb and viscous, 1/f, slow and fast in turn", in_turn);
  EXPECT_LE(in_turn.with(FrictionTerm::kStribeck), 1);
  EXPECT_LE(in_turn.all - in_turn.chosen[0], 2);
  const Counts ascending = count_forms(plain, test::pink_noise(), 200, kPlain, values);
  print("Coulomb and viscous, 1/f, from slow to fast", ascending);
  EXPECT_LE(ascending.with(FrictionTerm::kStribeck), 1);
  // a drift while speeds rise looks like an asymmetry: more than the stated chance
  EXPECT_LE(ascending.with(FrictionTerm::kAsymmetry), 8);
}

TEST(FrictionForms, AStribeckCurveIsFoundWithItsForm) {
  const FrictionTerms truth = kPlain.with(FrictionTerm::kStribeck);
  const std::map<std::string, double> values = {{"Fc", 3}, {"Fs", 4.2}, {"vs", 0.1}, {"Fv", 4}};
  const Counts slow = count_forms(stribeck, kSlow, 100, truth, values);
  print("Stribeck, AR(1)", slow);
  EXPECT_GE(slow.chosen[truth.bits], 95);
  EXPECT_GE(slow.held, 0.9 * slow.numbers);
  const Counts pink = count_forms(stribeck, test::pink_noise(), 100, truth, values);
  print("Stribeck, 1/f", pink);
  EXPECT_GE(pink.chosen[truth.bits], 90);
}

TEST(FrictionForms, ConcaveViscousFrictionIsFoundWithItsForm) {
  const FrictionTerms truth = kPlain.with(FrictionTerm::kPower);
  const Counts counts = count_forms(concave, kSlow, 100, truth, {{"Fc", 2}, {"c", 6}, {"p", 0.5}});
  print("concave viscous, AR(1)", counts);
  EXPECT_GE(counts.chosen[truth.bits], 90);
  EXPECT_GE(counts.held, 0.9 * counts.numbers);
}

TEST(FrictionForms, AnAsymmetryIsFoundWithItsForm) {
  const FrictionTerms truth = kPlain.with(FrictionTerm::kAsymmetry);
  const Counts counts =
      count_forms(asymmetric, kSlow, 100, truth, {{"Fc", 3}, {"Fv", 4}, {"dFv", 0.8}});
  print("asymmetry, AR(1)", counts);
  EXPECT_GE(counts.chosen[truth.bits], 95);
  EXPECT_GE(counts.held, 0.9 * counts.numbers);
}

TEST(FrictionForms, OneDirectionIsNotJudged) {
  test::MadeJoint joint;
  joint.friction = plain;
  const SteadyLevels both =
      steady_levels({{test::made_recording(joint, 1)}, 0, true, {}}, SteadyRules());
  SteadyLevels forward;
  forward.postures = 1;
  for (const SteadyLevel& own : both.levels) {
    if (own.run.speed > 0) forward.levels.push_back(own);
  }
  const auto count = static_cast<Eigen::Index>(forward.levels.size());
  forward.covariance = Eigen::MatrixXd::Identity(count, count);
  const FrictionForms forms = compete_forms(forward, true, SteadyRules());
  EXPECT_FALSE(forms.judged);
  EXPECT_NE(forms.why_not.find("both directions"), std::string::npos) << forms.why_not;
}

}  // namespace
}  // namespace dyngen::runtime
