// SPDX-License-Identifier: MIT
/// An effect beside the model, at given shapes.
#include "runtime/diagnosis/scans/hypothesis.h"

#include <gtest/gtest.h>

#include <cmath>

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
