// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/within_rounding.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/runtime/diagnosis/arm_competition.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

constexpr double kStep = 1e-3;  // rad

/// A sinusoidal error of a position, at any of a thousand orders, of recordings with a known step.
struct PositionErrorScene {
  PositionErrorScene() : data(test::arm_recordings(test::two_recordings({}, 1))) {
    const EffectLaw law = test::algebraic_law(
        "encoder", {"q", "d_qdd"},
        {{"a", EffectRole::kLinear, -1, 1, 0, 1e-3},
         {"b", EffectRole::kLinear, -1, 1, 0, 1e-3},
         {"n", EffectRole::kScanned, 1, 1000, 1, 1, false, 1000}},
        [](const VectorXd& v, const VectorXd& p) {
          return v[1] * (p[0] * std::cos(p[2] * v[0]) + p[1] * std::sin(p[2] * v[0]));
        });
    error = hypothesis_of(test::unknown(law, 1), {});
    for (EffectRun& run : data.runs) run.position_step = Eigen::Vector2d(0, kStep);
  }
  [[nodiscard]] bool within(const Hypothesis& hypothesis, double a, double b) const {
    EffectInstance estimate = hypothesis.effect;
    estimate.parameters << a, b, 20;
    return within_rounding(data, hypothesis, estimate);
  }

  EffectRecordings data;
  Hypothesis error;
};

TEST(WithinRounding, IsAnErrorBelowAQuarterOfTheStep) {
  const PositionErrorScene scene;
  // amplitudes of 0.5 and 1.4 quarters of the step
  EXPECT_TRUE(scene.within(scene.error, 0.3 * kStep / 4, 0.4 * kStep / 4));
  EXPECT_FALSE(scene.within(scene.error, kStep / 4, kStep / 4));
}

TEST(WithinRounding, IsNothingWhereNoStepIsKnown) {
  PositionErrorScene scene;
  scene.error.effect.joint = 0;
  EXPECT_FALSE(scene.within(scene.error, 1e-9, 0));
}

TEST(WithinRounding, IsNoOtherEffect) {
  PositionErrorScene scene;
  scene.error.ordered = false;
  EXPECT_FALSE(scene.within(scene.error, 1e-9, 0));
}

}  // namespace
}  // namespace dyngen::runtime
