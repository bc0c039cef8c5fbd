// SPDX-License-Identifier: MIT
#include "runtime/effects/effect_fit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "runtime/effects/effect_residual.h"
#include "runtime/estimation/decompositions.h"
#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using test::known;
using test::unknown;

constexpr double kSampleTime = 0.005;

EffectRecordings arm_recordings(const std::vector<MotionSource>& sources) {
  return effect_recordings(test::planar_arm(), test::planar_arm_tangents(), sources, {1, -1});
}

EffectFit fit(const std::vector<MotionSource>& sources,
              const std::vector<EffectInstance>& effects) {
  return fit_effects(arm_recordings(sources), effects);
}

const std::vector<Motion>& two_runs() {
  static const std::vector<Motion> runs = {test::sines(20, kSampleTime),
                                           test::sines(15, kSampleTime, 0.9, 0.4)};
  return runs;
}

TEST(EffectFit, WithoutNoiseEveryParameterComesBack) {
  const VectorXd beta = test::planar_arm_values();
  const std::vector<EffectInstance> truth = {known(test::stribeck_law(), 0, {4.2, 0.11}),
                                             known(test::load_friction_law(), 1, {0.06}),
                                             known(test::tilt_law(), -1, {0.15, 0.0})};
  const auto sources = test::measured(two_runs(), beta, truth, 1e-9, 0, 1);
  // the tilt's y is gravity's own direction: g is not looked for here
  EffectInstance tilt = unknown(test::tilt_law(), -1);
  tilt.law.parameters[1].role = EffectRole::kGiven;
  tilt.parameters[1] = 0;
  const EffectFit found =
      fit(sources, {unknown(test::stribeck_law(), 0), unknown(test::load_friction_law(), 1), tilt});
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.point.effects[0].parameters[0], 4.2, 1e-5);
  EXPECT_NEAR(found.point.effects[0].parameters[1], 0.11, 1e-6);
  EXPECT_NEAR(found.point.effects[1].parameters[0], 0.06, 1e-6);
  EXPECT_NEAR(found.point.effects[2].parameters[0], 0.15, 1e-5);
  EXPECT_LT((found.point.beta - beta).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT(found.rms.maxCoeff(), 1e-5);
  EXPECT_GT(found.rms_without.minCoeff(), 1e-2);
}

TEST(EffectFit, AScannedShapeIsFoundAmongManyMinima) {
  const VectorXd beta = test::planar_arm_values();
  const auto sources = test::measured(
      two_runs(), beta, {known(test::ripple_law(), 1, {0.3, -0.2, 37.3})}, 0.05, 0.5, 2);
  const EffectFit found = fit(sources, {unknown(test::ripple_law(), 1)});
  const auto& parameters = found.parameters[0];
  EXPECT_NEAR(parameters[2].value, 37.3, 5 * parameters[2].stddev);
  EXPECT_LT(parameters[2].stddev, 0.05);
  EXPECT_NEAR(parameters[0].value, 0.3, 5 * parameters[0].stddev);
  // with a number it is held
  EffectInstance held = unknown(test::ripple_law(), 1);
  held.parameters[2] = 37.3;
  const EffectFit with_number = fit(sources, {held});
  EXPECT_TRUE(with_number.parameters[0][2].held);
  EXPECT_EQ(with_number.parameters[0][2].value, 37.3);
}

TEST(EffectFit, TheStateAtTheBeginningIsFoundToo) {
  const VectorXd beta = test::planar_arm_values();
  // slow motions: an element whose reach is long in comparison
  const std::vector<Motion> slow = {test::sines(20, kSampleTime, 0.3, 0.3),
                                    test::sines(20, kSampleTime, 1.7, 0.3)};
  const EffectInstance slip = known(test::slip_law(), 1, {40, 0.05});
  auto sources = test::measured(slow, beta, {slip}, 1e-3, 0, 3);
  // the recordings begin in the middle of the motion, where the element is already stretched
  for (MotionSource& source : sources) source = part_of(source, 0.31, 1);
  const EffectFit found = fit(sources, {unknown(test::slip_law(), 1)});
  EXPECT_NEAR(found.parameters[0][0].value, 40, 6 * found.parameters[0][0].stddev);
  EXPECT_NEAR(found.parameters[0][1].value, 0.05, 6 * found.parameters[0][1].stddev);
  EXPECT_LT(found.rms[1], 1.5e-3);
  for (std::size_t run = 0; run < slow.size(); ++run) {
    // where the element was when the recording begins: what it did before
    const Motion& motion = slow[run];
    const Index before =
        static_cast<Index>(std::llround(0.31 * static_cast<double>(motion.samples())));
    VectorXd state = VectorXd::Zero(1);
    slip.law.evaluate(motion.dq.col(1).head(before + 1), slip.parameters, kSampleTime, state, {});
    EXPECT_NEAR(found.point.initial[run][0][0], state[0], 2e-3);
    EXPECT_GT(std::abs(state[0]), 0.01);
  }
}

// what repeats of a motion correct (leave_as_at) stands in the torque of the equations alone
TEST(EffectFit, AnUndoneDelayKeepsWhatEquationsHaveBesideTheRecording) {
  const VectorXd beta = test::planar_arm_values();
  EffectRecordings data = arm_recordings(test::measured(two_runs(), beta, {}, 0.1, 0, 5));
  const EffectPoint point{beta, {known(test::delay_law(), -1, {0.012})}, {}};
  const std::vector<RowBlock> recorded = without_effects(data, point);
  for (EffectRun& run : data.runs) run.rows.tau.col(1).array() += 0.7;
  const std::vector<RowBlock> more = without_effects(data, point);
  for (std::size_t run = 0; run < recorded.size(); ++run) {
    ASSERT_GT(recorded[run].counted.col(1).sum(), 100);
    const VectorXd added = more[run].tau.col(1) - recorded[run].tau.col(1);
    EXPECT_LT((added - 0.7 * recorded[run].counted.col(1)).cwiseAbs().maxCoeff(), 1e-12) << run;
    EXPECT_TRUE(more[run].tau.col(0).isApprox(recorded[run].tau.col(0), 1e-12)) << run;
  }
}

TEST(EffectFit, ADelayIsFoundWithoutBias) {
  const VectorXd beta = test::planar_arm_values();
  constexpr double kDelay = 0.0123;
  Motion motion = test::sines(30, kSampleTime, 0.2, 2.5);
  // the torque of the motion as it was before: exactly late
  const auto late =
      test::measured({test::sines(30, kSampleTime, 0.2, 2.5, -kDelay)}, beta, {}, 0.2, 0, 4);
  late.front().pieces([&](const StreamPiece& piece) { motion.tau = piece.motion.tau; });
  const std::vector<MotionSource> sources = {test::source_of(motion)};
  const EffectFit found = fit(sources, {unknown(test::delay_law(), -1)});
  const EffectParameterFit& delay = found.parameters[0][0];
  EXPECT_NEAR(delay.value, kDelay, 4 * delay.stddev);
  EXPECT_LT(delay.stddev, 5e-4);
}

TEST(EffectFit, ALagIsFoundWithoutBias) {
  const VectorXd beta = test::planar_arm_values();
  const std::vector<Motion> fast = {test::sines(30, kSampleTime, 0.2, 2.5)};
  const auto sources =
      test::measured(fast, beta, {known(test::lag_law(), -1, {0.0081})}, 0.2, 0, 5);
  const EffectFit found = fit(sources, {unknown(test::lag_law(), -1)});
  const EffectParameterFit& lag = found.parameters[0][0];
  EXPECT_NEAR(lag.value, 0.0081, 4 * lag.stddev);
  EXPECT_LT(lag.stddev, 5e-4);
}

TEST(EffectFit, APayloadInAWindowOfTimeIsFound) {
  const VectorXd beta = test::planar_arm_values();
  const auto sources = test::measured({two_runs()[0]}, beta,
                                      {known(test::payload_law(), -1, {0.8, 8, 14})}, 0.05, 0, 6);
  EffectInstance payload = unknown(test::payload_law(), -1);
  payload.parameters[1] = 8;
  payload.parameters[2] = 14;
  const EffectFit found = fit(sources, {payload});
  EXPECT_NEAR(found.parameters[0][0].value, 0.8, 4 * found.parameters[0][0].stddev);
  EXPECT_LT(found.parameters[0][0].stddev, 0.02);
}

TEST(EffectFit, ARequirementHoldsTheEstimateAndIsReported) {
  const VectorXd beta = test::planar_arm_values();
  // friction that falls to a stop: the opposite of what the law may say
  EffectLaw free = test::stribeck_law();
  free.requirements.clear();
  free.dissipates = false;
  const auto sources = test::measured(two_runs(), beta, {known(free, 0, {2.0, 0.2})}, 0.02, 0, 7);
  // at its width: a wide one would be viscous friction
  EffectInstance stribeck = unknown(test::stribeck_law(), 0);
  stribeck.law.parameters[1].role = EffectRole::kGiven;
  stribeck.parameters[1] = 0.2;
  const EffectFit found = fit(sources, {stribeck});
  const double Fc = found.point.beta[7], Fs = found.point.effects[0].parameters[0];
  EXPECT_GE(Fs, Fc - 1e-6);
  bool reported = false;
  for (const EffectRemark& remark : found.remarks) {
    reported = reported || (remark.kind == EffectRemark::Kind::kAtBound &&
                            remark.text.find("Fc <= Fs") != std::string::npos);
  }
  EXPECT_TRUE(reported);
}

TEST(EffectFit, AFalsifiedNameIsReported) {
  const VectorXd beta = test::planar_arm_values();
  const auto sources =
      test::measured(two_runs(), beta, {known(test::stribeck_law(), 0, {5.0, 0.8})}, 0.01, 0, 8);
  const EffectFit found = fit(sources, {unknown(test::stribeck_law(), 0)});
  bool reported = false;
  for (const EffectRemark& remark : found.remarks) {
    reported = reported || (remark.kind == EffectRemark::Kind::kFalsified &&
                            remark.text.find("vs <= 0.25*v90") != std::string::npos);
  }
  EXPECT_TRUE(reported);
}

TEST(EffectFit, AValueBeyondItsUsualRangeIsSaidAndDoesNotObject) {
  EffectLaw law = test::stribeck_law();
  law.usual = std::exchange(law.falsifiers, {});
  law.usual.front().parameters = {1};
  const VectorXd beta = test::planar_arm_values();
  const auto wide = test::measured(two_runs(), beta, {known(law, 0, {5.0, 0.8})}, 0.01, 0, 8);
  const EffectFit found = fit(wide, {unknown(law, 0)});
  int said = 0;
  for (const EffectRemark& remark : found.remarks) {
    EXPECT_NE(remark.kind, EffectRemark::Kind::kFalsified) << remark.text;
    if (remark.kind != EffectRemark::Kind::kUnusual) continue;
    ++said;
    EXPECT_FALSE(found.objects(remark, 0));
    EXPECT_EQ(remark.text,
              fmt::format("stribeck of joint 1: vs = {:.3g}: unusual, a wide band is viscous "
                          "friction that bends",
                          found.point.effects[0].parameters[1]));
  }
  EXPECT_EQ(said, 1);
  const auto narrow = test::measured(two_runs(), beta, {known(law, 0, {5.0, 0.05})}, 0.01, 0, 8);
  for (const EffectRemark& remark : fit(narrow, {unknown(law, 0)}).remarks) {
    EXPECT_NE(remark.kind, EffectRemark::Kind::kUnusual) << remark.text;
  }
}

/// Sizes of a law whose shape has to last for less than the recordings do.
EffectLaw slow_law(double least) {
  EffectLaw law = test::algebraic_law(
      "warming", {"t", "qd"},
      {{"k", EffectRole::kLinear, -10, 10, 0, 1}, {"warm", EffectRole::kShape, least, 1e9, 10, 10}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * v[1] * std::exp(-v[0] / p[1]); });
  law.sizes = [plain = law.sizes](const EffectScales& scales) {
    EffectSizes sizes = plain(scales);
    sizes.max[1] = scales.duration;
    return sizes;
  };
  return law;
}

TEST(EffectFit, RefusesAShapeThatIsSlowerThanTheRecordings) {
  EffectScales scales;
  scales.duration = 5;
  EXPECT_EQ(slower_than_recording(slow_law(10), scales), 1);
  EXPECT_EQ(slower_than_recording(slow_law(2), scales), -1);
  EXPECT_EQ(slower_than_recording(test::stribeck_law(), scales), -1);
  const VectorXd beta = test::planar_arm_values();
  const auto sources = test::measured(two_runs(), beta, {}, 0.01, 0, 9);
  try {
    (void)fit(sources, {unknown(slow_law(1e4), 0)});
    ADD_FAILURE() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("no warm is within its bounds"), std::string::npos)
        << error.what();
  }
  // a number is a number
  EXPECT_NO_THROW((void)fit(sources, {known(slow_law(1e4), 0, {0.1, 2e4})}));
}

TEST(EffectFit, WhatTheDataCannotSeeIsNamed) {
  const VectorXd beta = test::planar_arm_values();
  const auto sources = test::measured(two_runs(), beta, {}, 0.01, 0, 9);
  const EffectFit found = fit(sources, {unknown(test::coulomb_asymmetry_law(), 0)});
  ASSERT_FALSE(found.all_seen());
  EXPECT_FALSE(found.parameters[0][0].seen);
  EXPECT_NE(found.remarks[0].text.find("OFF1"), std::string::npos) << found.remarks[0].text;
}

TEST(EffectFit, AParameterThatIsNotSeenDoesNotObjectBesideOneThatIs) {
  const VectorXd beta = test::planar_arm_values();
  // a spring and its force at zero, which is the joint's offset
  const EffectLaw spring = test::algebraic_law(
      "gravity_spring", {"q"},
      {{"k", EffectRole::kLinear, -100, 100, 1, 1}, {"c", EffectRole::kLinear, -100, 100, 0, 1}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * v[0] + p[1]; });
  const auto sources = test::measured(two_runs(), beta, {known(spring, 1, {0.5, 0})}, 0.01, 0, 9);
  const EffectFit found = fit(sources, {unknown(spring, 1)});
  ASSERT_EQ(found.remarks.size(), 1U);
  EXPECT_EQ(found.remarks[0].kind, EffectRemark::Kind::kNotSeen);
  EXPECT_FALSE(found.objects(found.remarks[0], 0));
  const EffectFit nothing = fit(sources, {unknown(test::coulomb_asymmetry_law(), 0)});
  ASSERT_FALSE(nothing.remarks.empty());
  EXPECT_TRUE(nothing.objects(nothing.remarks[0], 0));
  EXPECT_FALSE(nothing.objects(nothing.remarks[0], 1));
}

TEST(EffectFit, TorqueThatIsNotFiniteIsRefused) {
  const EffectLaw root = test::algebraic_law(
      "root", {"q"},
      {{"k", EffectRole::kLinear, -10, 10, 0, 1}, {"x", EffectRole::kShape, 0, 9, 1, 1}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * std::sqrt(v[0] - p[1]); });
  const auto sources = test::measured(two_runs(), test::planar_arm_values(), {}, 0.1, 0, 1);
  EXPECT_THROW(fit(sources, {known(root, 0, {1, 1})}), NotFiniteError);
}

TEST(EffectFit, ABoundBeyondWhichNothingChangesIsNoRemark) {
  const VectorXd beta = test::planar_arm_values();
  const EffectLaw cooling = test::algebraic_law(
      "cooling", {"t", "qd"},
      {{"k", EffectRole::kLinear, -1000, 1000, 1, 1},
       {"warm", EffectRole::kShape, 1, 2000, 10, 10, true}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * v[1] * std::exp(-v[0] / p[1]); });
  // friction that grows faster and faster is not of the law: the longest time is nearest to it
  const EffectLaw growing = test::algebraic_law(
      "growing", {"t", "qd"}, {{"k", EffectRole::kLinear, -1000, 1000, 1, 1}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * v[1] * v[0] / 20; });
  const auto at_bound = [&](double size, unsigned seed) {
    const auto sources =
        test::measured(two_runs(), beta, {known(growing, 0, {size})}, 0.05, 0, seed);
    return fit(sources, {unknown(cooling, 0)});
  };
  int held = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const EffectFit found = at_bound(0.05, seed);
    held += found.parameters[0][1].at_bound ? 1 : 0;
    EXPECT_TRUE(found.remarks.empty()) << "seed " << seed << ": " << found.remarks[0].text;
  }
  EXPECT_GT(held, 0);
}

TEST(EffectFit, IntervalsCoverTheTruthUnderCorrelatedNoise) {
  constexpr int kTrials = 120;
  constexpr unsigned kSeed = 100;
  const VectorXd beta = test::planar_arm_values();
  const std::vector<EffectInstance> truth = {known(test::stribeck_law(), 0, {4.2, 0.11}),
                                             known(test::load_friction_law(), 1, {0.06})};
  const std::vector<Motion> run = {test::sines(40, 0.02, 0.1, 0.7)};
  int covered = 0, all = 0;
  for (unsigned trial = 0; trial < kTrials; ++trial) {
    const auto sources = test::measured(run, beta, truth, 0.15, 0.9, kSeed + trial);
    const EffectFit found =
        fit(sources, {unknown(test::stribeck_law(), 0), unknown(test::load_friction_law(), 1)});
    for (std::size_t k = 0; k < truth.size(); ++k) {
      for (std::size_t p = 0; p < found.parameters[k].size(); ++p) {
        const EffectParameterFit& parameter = found.parameters[k][p];
        const double error = parameter.value - truth[k].parameters[static_cast<Index>(p)];
        covered += std::abs(error) <= found.interval * parameter.stddev ? 1 : 0;
        ++all;
      }
    }
    const VectorXd error = found.point.beta - beta;
    for (const Index c : {0, 4, 7, 9}) {
      covered +=
          std::abs(error[c]) <= found.interval * std::sqrt(found.base.covariance(c, c)) ? 1 : 0;
      ++all;
    }
  }
  const double part = static_cast<double>(covered) / all;
  RecordProperty("covered", std::to_string(part));
  std::printf("95 %% intervals cover %.1f %% of %d (seeds from %u)\n", 100 * part, all, kSeed);
  EXPECT_GE(part, 0.90);
  EXPECT_LE(part, 0.98);
}

}  // namespace
}  // namespace dyngen::runtime
