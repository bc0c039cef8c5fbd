// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/half_band_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "runtime/diagnosis/equation_sets/repeated_motion.h"
#include "runtime/diagnosis/scans/generic_columns.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kPeriod = 400;

/// Two joints that repeat, with noise of the positions.
Motion repeating(Index samples, double period, double noise, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, 1);
  Motion motion;
  motion.sample_time = 0.01;
  motion.time = VectorXd::LinSpaced(samples, 0, 0.01 * static_cast<double>(samples - 1));
  const auto wave = [&](double harmonic, double size) {
    MatrixXd x(samples, 2);
    for (Index k = 0; k < samples; ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k) / period * harmonic;
      x.row(k) << size * std::sin(angle), size * (std::cos(angle) + 0.5 * std::sin(2 * angle));
    }
    return x;
  };
  const auto with_noise = [&](MatrixXd x) -> MatrixXd {
    return x.unaryExpr([&](double value) { return value + noise * normal(random); });
  };
  motion.q = with_noise(wave(1, 1));
  motion.dq = with_noise(wave(1, 1.5));
  motion.ddq = with_noise(wave(1, 2.5));
  motion.tau = with_noise(wave(1, 3));
  return motion;
}

Motion repeated(const Motion& motion) {
  const MotionSource source = with_repeated_motion(test::source_of(motion));
  Motion result;
  int runs = 0;
  source.pieces([&](const StreamPiece& piece) {
    result = piece.motion;
    ++runs;
  });
  EXPECT_EQ(runs, 1);
  return result;
}

TEST(RepeatedMotion, IsTheMeanOfTheOtherPeriods) {
  const Motion motion = repeating(3 * kPeriod + 50, kPeriod, 1e-3, 1);
  const Motion others = repeated(motion);
  for (const Index k : {Index{7}, 2 * kPeriod + 70, 3 * kPeriod + 20}) {
    VectorXd mean = VectorXd::Zero(2);
    int count = 0;
    for (Index i = k % kPeriod; i < motion.samples(); i += kPeriod) {
      if (i == k) continue;
      mean += motion.ddq.row(i);
      ++count;
    }
    mean /= count;
    EXPECT_TRUE(others.ddq.row(k).transpose().isApprox(mean, 1e-12)) << k;
  }
  EXPECT_EQ(others.tau, motion.tau);
  EXPECT_EQ(others.time, motion.time);
}

TEST(RepeatedMotion, HasNoiseOfItsOwn) {
  const Motion noisy = repeating(5 * kPeriod, kPeriod, 1e-3, 2);
  const Motion exact = repeating(5 * kPeriod, kPeriod, 0, 2), others = repeated(noisy);
  const MatrixXd own = noisy.q - exact.q, theirs = others.q - exact.q;
  EXPECT_NEAR(theirs.norm() / own.norm(), 0.5, 0.05);  // of four periods
  EXPECT_LT(std::abs((own.array() * theirs.array()).sum()), 0.06 * own.norm() * theirs.norm());
}

TEST(RepeatedMotion, OfWhatDoesNotRepeatInWholeSamplesIsTheSame) {
  for (const double period : {400.4, 5000.0}) {
    const Motion motion = repeating(4 * kPeriod, period, 1e-3, 3);
    EXPECT_EQ(repeated(motion).q, motion.q) << period;
  }
}

/// What columns of a structure explain of recordings.
Nameless said_of(const EffectRecordings& data, const GenericStructure& structure) {
  EffectSignals signals(data);
  const EvidenceSystem system = test::arm_system(data);
  Nameless nameless;
  nameless.structure = structure;
  nameless.score = score_of(
      system.products(system.whitened(generic_columns(data, signals, structure)), false), false);
  return nameless;
}

TEST(HalfBandTest, ContradictsWhatIsNotInItsEquations) {
  EffectInstance spring = test::known(test::spring_law(), 1, {0.4});
  spring.law.family = "spring";
  const EffectRecordings with = test::arm_recordings(test::two_recordings({spring}, 1));
  const EffectRecordings again = test::arm_recordings(test::two_recordings({spring}, 2));
  const EffectRecordings without = test::arm_recordings(test::two_recordings({}, 3));
  CompetitionResult result;
  result.fit.point.beta = test::planar_arm_values();

  const Nameless nameless = said_of(with, {1, {{StructureVariable::Kind::kPosition, 1}}});
  ASSERT_GT(nameless.score.delta_chi2, 60);
  EXPECT_FALSE(HalfBandTest(again).contradicts({}, result, nameless, {}));
  EXPECT_TRUE(HalfBandTest(without).contradicts({}, result, nameless, {}));

  EffectInstance asked = test::unknown(test::spring_law(), 1);
  const Hypothesis hypothesis =
      hypothesis_of(asked, ScaleTable(with).of(test::planar_arm_values(), asked));
  EffectPoint point = result.fit.point;
  point.effects = {spring};
  point.effects[0].parameters[0] = 0.4;
  EXPECT_FALSE(HalfBandTest(again).contradicts({hypothesis}, result, hypothesis, point, {}));
  EXPECT_TRUE(HalfBandTest(without).contradicts({hypothesis}, result, hypothesis, point, {}));
}

}  // namespace
}  // namespace dyngen::runtime
