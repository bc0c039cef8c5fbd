// SPDX-License-Identifier: MIT
/// The noise of recordings that do not repeat, beside the largest plausible model.
#include "runtime/diagnosis/scans/largest_model.h"

#include <gtest/gtest.h>

#include "runtime/diagnosis/competition/heldout.h"
#include "runtime/effects/effect_fit.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

/// The noise that is estimated with the fitted model alone, and beside the largest one.
struct Noises {
  TorqueNoiseModel alone, beside;
};

Noises noises_of(const std::vector<EffectInstance>& effects, double coefficient, unsigned seed) {
  const EffectRecordings data = test::arm_recordings(
      test::measured({test::sines(15, 0.01, 0.3), test::sines(15, 0.01, 2.3)},
                     test::planar_arm_values(), effects, test::kArmNoise, coefficient, seed));
  const EffectFit fit = fit_effects(data, {});
  EffectSignals signals(data);
  signals.set_beta(fit.point.beta);
  const RunResiduals residuals = residuals_of(data, fit.point);
  const std::vector<double> none(data.runs.size(), 0.0);
  return {torque_noise_model(data, residuals, none, true),
          torque_noise_model(data, residuals, none, true, {}, largest_model(data, signals, {}))};
}

/// Of white noise the standard deviation, of both joints, over the true one.
VectorXd levels(const TorqueNoiseModel& noise) {
  return VectorXd{{noise.joints[0].deviation(), noise.joints[1].deviation()}} / test::kArmNoise;
}

TEST(LargestModel, LeavesTheNoiseWithoutWhatTheModelLacks) {
  const std::vector<EffectInstance> lacking = {test::known(test::spring_law(), 0, {1.5}),
                                               test::known(test::load_friction_law(), 1, {0.3})};
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Noises noises = noises_of(lacking, 0, seed);
    SCOPED_TRACE(levels(noises.alone).transpose());
    EXPECT_TRUE(noises.beside.free_of_structure());
    EXPECT_FALSE(noises.alone.free_of_structure());
    EXPECT_GT(levels(noises.alone).maxCoeff(), 1.8) << seed;
    EXPECT_NEAR(levels(noises.beside)[0], 1, 0.1) << seed;
    // the load is that of a model which has taken up a part of the effect
    EXPECT_LT(levels(noises.beside)[1], 1.3) << seed;
  }
}

TEST(LargestModel, PutsBackTheNoiseThatItTakes) {
  constexpr unsigned kSeeds = 5;
  for (const double coefficient : {0.0, 0.9}) {
    VectorXd level = VectorXd::Zero(2), density = VectorXd::Zero(2);
    for (unsigned seed = 1; seed <= kSeeds; ++seed) {
      const TorqueNoiseModel noise = noises_of({}, coefficient, seed).beside;
      level += levels(noise) / kSeeds;
      for (int j = 0; j < 2; ++j) {
        density[j] += noise.joints[static_cast<std::size_t>(j)].density(0) / kSeeds;
      }
    }
    EXPECT_NEAR(level[0], 1, 0.06) << coefficient;
    EXPECT_NEAR(level[1], 1, 0.06) << coefficient;
    // of an autoregressive process of order 1 at 0: (1 + c) / (1 - c) times the variance
    const double slow = (1 + coefficient) / (1 - coefficient) * test::kArmNoise * test::kArmNoise;
    EXPECT_NEAR(density[0] / slow, 1, 0.35) << coefficient;
    EXPECT_NEAR(density[1] / slow, 1, 0.35) << coefficient;
  }
}

TEST(LargestModel, IsEmptyWhereEquationsAreTooFew) {
  const EffectRecordings data = test::arm_recordings(test::measured(
      {test::sines(1.2, 0.01)}, test::planar_arm_values(), {}, test::kArmNoise, 0, 1));
  EffectSignals signals(data);
  signals.set_beta(test::planar_arm_values());
  EXPECT_TRUE(largest_model(data, signals, {}).empty());
}

}  // namespace
}  // namespace dyngen::runtime
