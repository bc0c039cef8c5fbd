// SPDX-License-Identifier: MIT
#include "runtime/estimation/burg.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "runtime/estimation/joint_noise.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr unsigned kSeed = 20261121;

AutoregressiveNoise process(std::initializer_list<double> coefficients, double innovation) {
  AutoregressiveNoise noise;
  noise.coefficients.resize(static_cast<Index>(coefficients.size()));
  Index at = 0;
  for (const double a : coefficients) noise.coefficients[at++] = a;
  noise.innovation = innovation;
  noise.deviation = std::sqrt(autocovariance(noise, 0)[0]);
  return noise;
}

VectorXd series_of(const AutoregressiveNoise& noise, Index samples, std::mt19937_64& random) {
  constexpr Index kRunIn = 500;
  std::normal_distribution<double> normal;
  VectorXd x = VectorXd::Zero(kRunIn + samples);
  for (Index t = 0; t < x.size(); ++t) {
    x[t] = noise.innovation * normal(random);
    for (Index k = 0; k < std::min(t, noise.coefficients.size()); ++k) {
      x[t] += noise.coefficients[k] * x[t - 1 - k];
    }
  }
  return x.tail(samples);
}

/// 0 in gaps of 3 to 10 samples, 8 to 25 apart.
VectorXd with_gaps(Index samples, std::mt19937_64& random) {
  std::uniform_int_distribution<Index> gap(3, 10), apart(8, 25);
  VectorXd counted = VectorXd::Ones(samples);
  for (Index t = apart(random); t < samples; t += apart(random)) {
    const Index end = std::min(samples, t + gap(random));
    counted.segment(t, end - t).setZero();
    t = end;
  }
  return counted;
}

TEST(Burg, FindsAProcessBetweenGaps) {
  const AutoregressiveNoise truth = process({1.5, -0.8}, 0.7);
  std::mt19937_64 random(kSeed);
  const VectorXd x = series_of(truth, 6000, random), counted = with_gaps(6000, random);
  const AutoregressiveNoise found = autoregression_of(stretches_of(x, counted), 40);
  ASSERT_EQ(found.coefficients.size(), 2) << found.coefficients.transpose();
  // asymptotic deviation of a coefficient: sqrt((1 - a_2^2) / N), N samples with two before them
  const double deviation = std::sqrt((1 - 0.8 * 0.8) / 3000);
  EXPECT_NEAR(found.coefficients[0], 1.5, 4 * deviation);
  EXPECT_NEAR(found.coefficients[1], -0.8, 4 * deviation);
  EXPECT_NEAR(found.innovation / 0.7, 1, 4 * std::sqrt(0.5 / 3000));
}

TEST(Burg, HasTheCorrelationTimeOfTheProcess) {
  const AutoregressiveNoise truth = process({0.8}, 1);
  std::mt19937_64 random(kSeed);
  const VectorXd x = series_of(truth, 20000, random);
  const AutoregressiveNoise found = autoregression_of({x}, 40);
  EXPECT_NEAR(found.correlation_time, (1 + 0.8) / (1 - 0.8), 1);
  EXPECT_NEAR(found.deviation, truth.deviation, 0.05 * truth.deviation);
}

/// What a narrow band leaves is nearly determined by its past: products of what lies about gaps
/// give autocovariances that belong to no process, and forward and backward errors a stable one.
TEST(Burg, IsStableOfANarrowBandWithGaps) {
  const AutoregressiveNoise band = process({2.6, -2.6, 1.1, -0.15}, 1);
  for (unsigned seed = kSeed; seed < kSeed + 20; ++seed) {
    std::mt19937_64 random(seed);
    const VectorXd x = series_of(band, 500, random), counted = with_gaps(500, random);
    const AutoregressiveNoise found = autoregression_of(stretches_of(x, counted), 40);
    const double variance = autocovariance(found, 0)[0];
    EXPECT_GT(found.innovation, 0.5) << seed;
    EXPECT_LT(found.innovation, 1.5) << seed;
    EXPECT_NEAR(std::sqrt(variance), found.deviation, 0.2 * found.deviation) << seed;
  }
}

TEST(Burg, TakesWhiteNoiseForWhite) {
  int whiter = 0;
  constexpr unsigned kTrials = 100;
  for (unsigned seed = kSeed; seed < kSeed + kTrials; ++seed) {
    std::mt19937_64 random(seed);
    const VectorXd x = series_of(process({}, 2), 400, random), counted = with_gaps(400, random);
    whiter += autoregression_of(stretches_of(x, counted), 40).coefficients.size() == 0 ? 1 : 0;
  }
  EXPECT_GE(whiter, 90);
}

TEST(Burg, OfNothingIsNothing) {
  const AutoregressiveNoise found = autoregression_of({VectorXd::Zero(5), VectorXd(0)}, 3);
  EXPECT_EQ(found.innovation, 0);
  EXPECT_EQ(found.coefficients.size(), 0);
  EXPECT_EQ(autoregression_of({}, 3).deviation, 0);
}

TEST(Stretches, LieBetweenWhatDoesNotCount) {
  VectorXd series(7), counted(7);
  series << 1, 2, 3, 4, 5, 6, 7;
  counted << 0, 1, 1, 0, 0, 1, 1;
  const std::vector<VectorXd> stretches = stretches_of(series, counted);
  ASSERT_EQ(stretches.size(), 2U);
  EXPECT_EQ(stretches[0], (VectorXd(2) << 2, 3).finished());
  EXPECT_EQ(stretches[1], (VectorXd(2) << 6, 7).finished());
  EXPECT_TRUE(stretches_of(series, VectorXd::Zero(7)).empty());
}

}  // namespace
}  // namespace dyngen::runtime
