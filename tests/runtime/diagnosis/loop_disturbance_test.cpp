// SPDX-License-Identifier: MIT
/// A torque that the controller answers and nobody records, in motions that do not repeat.
#include "runtime/diagnosis/competition/loop_disturbance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "runtime/diagnosis/competition/heldout.h"
#include "runtime/evidence/motion_innovations.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLevel = 0.002;
constexpr double kSample = 0.02, kMemory = 0.1;  // s
constexpr double kBandwidth = 30;                // rad/s, of the loop
constexpr double kInertia[2] = {1.5, 0.4};       // kg m^2, that the loop moves

/// Adds to a motion what a torque moves in a loop of second order. @param size  N m, deviation
/// @return  the torque, (N x 2)
MatrixXd disturb(Motion& motion, double size, unsigned seed) {
  constexpr int kSteps = 40;  // of the integration, for a sample
  constexpr double kStep = kSample / kSteps;
  const double pole = std::exp(-kStep / kMemory);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  MatrixXd torque(motion.samples(), 2);
  for (Index j = 0; j < 2; ++j) {
    double d = size * normal(random), x = 0, v = 0;
    for (Index k = 0; k < motion.samples(); ++k) {
      const double a = d / kInertia[j] - kBandwidth * kBandwidth * x - 1.4 * kBandwidth * v;
      motion.q(k, j) += x;
      motion.dq(k, j) += v;
      motion.ddq(k, j) += a;
      torque(k, j) = d;
      for (int step = 0; step < kSteps; ++step) {
        v += kStep * (d / kInertia[j] - kBandwidth * kBandwidth * x - 1.4 * kBandwidth * v);
        x += kStep * v;
        d = pole * d + size * std::sqrt(1 - pole * pole) * normal(random);
      }
    }
  }
  return torque;
}

/// Two recordings of 30 s with a disturbance, and a torque that comes late.
/// @param size  N m; 0: none   @param late  s
EffectRecordings recorded(double size, double late, unsigned seed) {
  std::vector<MotionSource> sources;
  for (unsigned i = 0; i < 2; ++i) {
    Motion motion = test::sines(30, kSample, 0.3 + 2 * i);
    const MatrixXd torque = disturb(motion, size, 2 * seed + i);
    const MotionSource source = test::measured({motion}, test::planar_arm_values(), {},
                                               test::kArmNoise, 0, 1000 + 2 * seed + i)[0];
    source.pieces([&](const StreamPiece& piece) { motion = piece.motion; });
    motion.tau -= torque;  // what the drive gives: M qdd + h = tau + d
    const MatrixXd tau = motion.tau;
    for (Index k = 1; k + 1 < motion.samples(); ++k) {
      motion.tau.row(k) -= late / (2 * kSample) * (tau.row(k + 1) - tau.row(k - 1));
    }
    sources.push_back(test::source_of(motion));
  }
  return test::arm_recordings(sources);
}

/// The model beside recordings, and what is asked of it.
struct Judged {
  explicit Judged(const EffectRecordings& recordings)
      : data(recordings),
        fit(fit_effects(data, {})),
        noise(torque_noise_model(data, residuals_of(data, fit.point), {0, 0}, true)),
        system(data, residuals_of(data, fit.point), noise, {}),
        signals(data),
        disturbance(data, noise, kLevel) {
    signals.set_beta(fit.point.beta);
  }

  /// Whitened columns of a delay.
  JointColumns delay() {
    const EffectInstance effect = test::known(test::delay_law(), -1, {0.0});
    return system.whitened(effect_columns(data, signals, effect, {1}));
  }
  double chi_square(const JointColumns& white) const {
    return score_of(system.products(white, false), false).delta_chi2;
  }

  EffectRecordings data;
  EffectFit fit;
  TorqueNoiseModel noise;
  EvidenceSystem system;
  EffectSignals signals;
  LoopDisturbance disturbance;
};

TEST(LoopDisturbance, IsSeenWhereTheMotionFollowsIt) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Judged judged(recorded(0.3, 0, seed));
    EXPECT_THAT(judged.disturbance.joints_beside(judged.system), testing::ElementsAre(0, 1))
        << seed;
  }
}

TEST(LoopDisturbance, IsNotSeenInNoiseOfTheSensor) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Judged judged(recorded(0, 0, seed));
    EXPECT_TRUE(judged.disturbance.joints_beside(judged.system).empty()) << seed;
  }
}

TEST(LoopDisturbance, ExplainsADelayThatIsNotThere) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Judged judged(recorded(0.3, 0, seed));
    const JointColumns delay = judged.delay();
    const double alone = judged.chi_square(delay);
    const auto left = judged.disturbance.beside_it(judged.system, delay, delay);
    ASSERT_TRUE(left) << seed;
    EXPECT_GT(alone, 50) << seed;
    EXPECT_LT(left->delta_chi2, 0.2 * alone) << seed;
  }
}

TEST(LoopDisturbance, LeavesADelayThatIsThere) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Judged judged(recorded(0, 0.01, seed));
    const JointColumns delay = judged.delay();
    EXPECT_GT(judged.chi_square(delay), 100) << seed;
    EXPECT_FALSE(judged.disturbance.beside_it(judged.system, delay, delay)) << seed;
  }
}

TEST(LoopDisturbance, IsNotAskedWherePeriodsAreTheInstrument) {
  Judged judged(recorded(0.3, 0, 1));
  judged.noise.from_periods = true;
  const LoopDisturbance disturbance(judged.data, judged.noise, kLevel);
  EXPECT_TRUE(disturbance.joints_beside(judged.system).empty());
  EXPECT_FALSE(disturbance.beside_it(judged.system, judged.delay(), judged.delay()));
}

}  // namespace
}  // namespace dyngen::runtime
