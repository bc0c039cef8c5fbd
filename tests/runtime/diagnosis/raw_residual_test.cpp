// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/equation_sets/raw_residual.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/diagnosis/diagnosis.h"
#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kStep = 0.004;    // s, of the recordings
constexpr double kRawNoise = 0.1;  // N m

/// A recording whose torque is that of a motion some time before: no delay is interpolated.
MotionSource late(double seconds, double phase, double delay, unsigned seed) {
  const Motion motion = test::sines(seconds, kStep, phase);
  const std::vector<MotionSource> before =
      test::measured({test::sines(seconds, kStep, phase, 1, -delay)}, test::planar_arm_values(), {},
                     kRawNoise, 0, seed);
  Motion shown = motion;
  before.front().pieces([&](const StreamPiece& piece) { shown.tau = piece.motion.tau; });
  return test::source_of(shown);
}

EffectRecordings equations(const MotionSource& source) {
  return effect_recordings(test::planar_arm(), test::planar_arm_tangents(), {source}, {5, -1});
}

/// 5 ms are 1.25 samples.
TEST(RawResidual, OfADelayThatIsKnownIsTheNoise) {
  const EffectRecordings data = equations(late(30, 0.3, 0.005, 1));
  const EffectPoint on_time = at_rest(data, test::planar_arm_values(), {});
  const EffectPoint later =
      at_rest(data, test::planar_arm_values(), {test::known(test::delay_law(), -1, {0.005})});
  const VectorXd before = raw_rms(data, raw_residuals(data, on_time));
  const VectorXd after = raw_rms(data, raw_residuals(data, later));
  for (Index j = 0; j < 2; ++j) {
    EXPECT_GT(before[j], 1.5 * kRawNoise);
    EXPECT_NEAR(after[j], kRawNoise, 0.03 * kRawNoise);
  }
}

/// Where a joint stands still friction may be anything: that is no noise.
TEST(RawResidual, TheFloorIsOfEquationsThatCount) {
  constexpr double kPeriod = 10;
  EffectRecordings data = equations(late(30, 0.3, 0, 2));
  RunResiduals residuals = raw_residuals(data, at_rest(data, test::planar_arm_values(), {}));
  EffectRun& run = data.runs.front();
  const auto factor = static_cast<double>(run.decimator.factor);
  const std::vector<double> repeats = {kPeriod / (kStep * factor)};
  const VectorXd before = raw_floor(data, residuals, repeats);
  EXPECT_NEAR(before[1], kRawNoise, 0.05 * kRawNoise);
  const Index some = run.rows.Y.rows() / 4;
  run.rows.counted.col(1).head(some).setZero();
  residuals.front()
      .col(1)
      .head(first_sample(run.decimator) + (some - 1) * run.decimator.factor)
      .setConstant(7);
  const VectorXd after = raw_floor(data, residuals, repeats);
  EXPECT_EQ(after[0], before[0]);
  EXPECT_NEAR(after[1], kRawNoise, 0.05 * kRawNoise);
}

/// u = x + T dx/dt by hand: the parallel filter passes this motion, so nothing but noise is left.
TEST(RawResidual, OfALagThatIsKnownIsTheNoise) {
  constexpr double kLag = 0.016;
  Motion motion = test::sines(30, kStep, 0.3);
  VectorXd beta = test::planar_arm_values();
  const LinearModel arm = test::planar_arm();
  for (const int joint : {0, 1}) beta[parameter_of(arm, joint, ParameterKind::kCoulomb)] = 0;
  const auto torque = [&](double start) {
    const Motion at = test::sines(30, kStep, 0.3, 1, start);
    return arm.torque(at.q, at.dq, at.ddq, beta);
  };
  constexpr double kSmall = 1e-5;  // s
  const MotionSource noise = test::measured({motion}, 0 * beta, {}, kRawNoise, 0, 2).front();
  noise.pieces([&](const StreamPiece& piece) { motion.tau = piece.motion.tau; });
  motion.tau += torque(0) + kLag * (torque(kSmall) - torque(-kSmall)) / (2 * kSmall);
  const EffectRecordings data = equations(test::source_of(motion));
  const VectorXd before = raw_rms(data, raw_residuals(data, at_rest(data, beta, {})));
  const VectorXd after = raw_rms(
      data, raw_residuals(data, at_rest(data, beta, {test::known(test::lag_law(), -1, {kLag})})));
  for (Index j = 0; j < 2; ++j) {
    EXPECT_GT(before[j], 1.5 * kRawNoise);
    EXPECT_NEAR(after[j], kRawNoise, 0.03 * kRawNoise);
  }
}

/// The finding leaves the floor of the noise, and what its evidence says of the held-out rms is
/// what the raw torque shows.
TEST(RawResidual, ReachesTheFloorOnceADelayIsFound) {
  DiagnosisInput input;
  input.model = test::planar_arm();
  input.robot = test::planar_arm_tangents();
  input.train = {late(30, 0.3, 0.005, 3), late(30, 2.1, 0.005, 4)};
  input.heldout = {late(20, 4.2, 0.005, 5)};
  for (const EffectLaw& law : {test::delay_law(), test::stribeck_law(), test::spring_law()}) {
    EffectInstance effect = test::unknown(law, law.acts_on_all ? -1 : 0);
    effect.law.family = law.name;
    effect.link = effect.joint + 1;
    input.hypotheses.push_back(effect);
  }
  DiagnosisOptions options;
  options.decimation = 5;
  const Diagnosis diagnosis = diagnose(input, options);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  const Finding& finding = diagnosis.findings.front();
  EXPECT_EQ(finding.effect.law.name, "time_delay");
  EXPECT_NEAR(finding.effect.parameters[0], 0.005, 3e-4);
  for (Index j = 0; j < 2; ++j) {
    EXPECT_GT(diagnosis.heldout.before[j], 1.5 * kRawNoise);
    // friction turns as late as the delay is wrong, some hundredths of a millisecond
    EXPECT_NEAR(diagnosis.heldout.after[j], kRawNoise, 0.2 * kRawNoise);
    EXPECT_NEAR(diagnosis.heldout.floor[j], kRawNoise, 0.2 * kRawNoise);
  }
}

}  // namespace
}  // namespace dyngen::runtime
