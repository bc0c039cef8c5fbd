// SPDX-License-Identifier: MIT
/// An effect beside the model, at given shapes.
#include "runtime/diagnosis/scans/hypothesis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/diagnosis/competition/competition_result.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

/// A wave over the position; its second parameter moves nothing, and is the larger one.
/// @param least  N m: the size of the wave at which there is no torque
EffectLaw wave_law(double least) {
  return test::algebraic_law("wave", {"q"},
                             {{"size", EffectRole::kLinear, -10, 10, 0, 0.1 + least},
                              {"idle", EffectRole::kLinear, -10, 10, 0, 7}},
                             [least](const VectorXd& v, const VectorXd& p) {
                               return (p[0] - least) * std::sin(5 * v[0]);
                             });
}

class TryHypothesis : public testing::Test {
 protected:
  TryHypothesis()
      : data_(
            test::arm_recordings(test::two_recordings({test::known(wave_law(0), 0, {0.4, 0})}, 3))),
        signals_(data_),
        system_(test::arm_system(data_)) {
    signals_.set_beta(test::planar_arm_values());
  }

  TrialScore score_of(const EffectLaw& law) {
    const EffectInstance effect = test::unknown(law, 0);
    const EffectScales scales = ScaleTable(data_).of(test::planar_arm_values(), effect);
    const Hypothesis hypothesis = hypothesis_of(effect, scales);
    return try_hypothesis(data_, signals_, system_, hypothesis, hypothesis.effect, scales, false);
  }

  EffectRecordings data_;
  EffectSignals signals_;
  EvidenceSystem system_;
};

TEST_F(TryHypothesis, FindsTheSizeOfAnEffectWhereverItIsNone) {
  const TrialScore plain = score_of(wave_law(0));
  EXPECT_NEAR(plain.effect.parameters[0], 0.4, 0.02);
  EXPECT_NEAR(plain.typical[0], 0.1, 1e-9);
  const TrialScore moved = score_of(wave_law(2));
  EXPECT_NEAR(moved.effect.parameters[0], plain.effect.parameters[0] + 2, 1e-6);
  EXPECT_NEAR(moved.typical[0], 0.1, 1e-6);
  EXPECT_NEAR(moved.score.delta_chi2, plain.score.delta_chi2, 1e-6 * plain.score.delta_chi2);
}

TEST_F(TryHypothesis, OfAProportionalLawIsTheSameWithoutItsTorque) {
  EffectLaw law = wave_law(0);
  const TrialScore by_torque = score_of(law);
  law.proportional = true;
  const TrialScore without = score_of(law);
  EXPECT_EQ(without.score.delta_chi2, by_torque.score.delta_chi2);
  EXPECT_EQ(without.effect.parameters[0], by_torque.effect.parameters[0]);
  EXPECT_EQ(without.typical_lambda, by_torque.typical_lambda);
}

/// Forces of the typical size meet the first joint's axis. A moment is seen there.
TEST_F(TryHypothesis, GivesASizeToTheFirstParameterThatIsSeen) {
  EffectInstance effect = test::unknown(test::contact_law(), 0);
  effect.link = 1;
  const EffectScales scales = ScaleTable(data_).of(test::planar_arm_values(), effect);
  const Hypothesis hypothesis = hypothesis_of(effect, scales);
  const TrialScore score =
      try_hypothesis(data_, signals_, system_, hypothesis, hypothesis.effect, scales, false);
  EXPECT_EQ(score.typical[0], 0);
  EXPECT_EQ(score.typical[1], 0);
  EXPECT_GT(score.typical[2], 0);
  EXPECT_NEAR(score.typical_lambda, 1, 1e-9);
}

/// A limit of a parameter, as a usual range.
EffectCondition at_most(int parameter, double limit) {
  EffectCondition condition;
  condition.spelling = "small";
  condition.parameters = {parameter};
  condition.slack = [=](const VectorXd& p, const EffectScales&) { return limit - p[parameter]; };
  return condition;
}

TEST_F(TryHypothesis, LetsWhatIsUnusualPayForIt) {
  EffectLaw law = wave_law(0);
  const TrialScore plain = score_of(law);
  EXPECT_EQ(plain.unusual, 0);
  law.usual = {at_most(0, 0.5)};
  EXPECT_EQ(score_of(law).unusual, 0);
  law.usual.push_back(at_most(0, 0.3));
  const TrialScore large = score_of(law);
  EXPECT_TRUE(large.admissible);
  EXPECT_EQ(large.unusual, PriorRules().unusual_value);
  EXPECT_EQ(large.score.delta_chi2, plain.score.delta_chi2);
  EXPECT_EQ(large.priced(), plain.priced() - large.unusual);
  law.usual.push_back(at_most(0, 0.2));
  EXPECT_EQ(score_of(law).unusual, 2 * large.unusual);
  Hypothesis hypothesis;
  hypothesis.linear = {0, 1};
  TorqueNoiseModel noise = test::arm_noise();
  noise.worth = VectorXd::Constant(2, 5000);
  EXPECT_NEAR(net_of(hypothesis, large, noise), net_of(hypothesis, plain, noise) - large.unusual,
              1e-9);
}

/// The shape inside the usual range is taken unless the one outside is better by its price.
TEST_F(TryHypothesis, TakesAShapeOutsideItsUsualRangeForMoreThanItsPrice) {
  EffectLaw law = test::algebraic_law(
      "wave", {"q"},
      {{"size", EffectRole::kLinear, -10, 10, 0, 0.1}, {"n", EffectRole::kShape, 1, 9, 4, 4}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * std::sin(p[1] * v[0]); });
  const auto shape = [&](double limit) {
    law.usual = {at_most(1, limit)};
    const EffectInstance effect = test::unknown(law, 0);
    const EffectScales scales = ScaleTable(data_).of(test::planar_arm_values(), effect);
    const Hypothesis hypothesis = hypothesis_of(effect, scales);
    EffectInstance start = hypothesis.effect;
    start.parameters[1] = std::min(4.8, limit - 1e-4);
    return refined(data_, signals_, system_, hypothesis,
                   try_hypothesis(data_, signals_, system_, hypothesis, start, scales, false),
                   scales);
  };
  const TrialScore inside = shape(1000);
  EXPECT_NEAR(inside.effect.parameters[1], 5, 0.05);
  EXPECT_EQ(inside.unusual, 0);
  // a limit just below the estimate: hardly worse inside
  const double near = inside.effect.parameters[1] - 1e-3;
  const TrialScore held = shape(near);
  EXPECT_LE(held.effect.parameters[1], near);
  EXPECT_EQ(held.unusual, 0);
  EXPECT_GT(held.score.delta_chi2, inside.score.delta_chi2 - PriorRules().unusual_value);
  // far below: what is outside pays
  const TrialScore beyond = shape(4);
  EXPECT_NEAR(beyond.effect.parameters[1], inside.effect.parameters[1], 0.02);
  EXPECT_EQ(beyond.unusual, PriorRules().unusual_value);
}

TEST_F(TryHypothesis, GivesNoSizeToWhatMovesNothing) {
  EffectLaw law = wave_law(0);
  law.proportional = true;
  const TrialScore score = score_of(law);
  EXPECT_EQ(score.typical[1], 0);
  EXPECT_EQ(score.effect.parameters[1], 0);
  EXPECT_GT(score.typical_lambda, 0);
}

}  // namespace
}  // namespace dyngen::runtime
