// SPDX-License-Identifier: MIT
#include "runtime/estimation/whitener.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

AutoregressiveNoise second_order() {
  // poles 0.9 and -0.4; the variance from the Yule-Walker equations
  AutoregressiveNoise noise;
  noise.coefficients = Eigen::Vector2d(0.5, 0.36);
  noise.innovation = 0.3;
  noise.deviation = 0.3 / std::sqrt((1 + 0.36) * ((1 - 0.36) * (1 - 0.36) - 0.25) / (1 - 0.36));
  return noise;
}

MatrixXd drawn(const AutoregressiveNoise& noise, Index samples, Index columns) {
  constexpr Index kRunIn = 300;
  std::mt19937_64 random(20261121);
  std::normal_distribution<double> normal;
  MatrixXd x(kRunIn + samples, columns);
  for (Index c = 0; c < columns; ++c) {
    for (Index t = 0; t < x.rows(); ++t) {
      x(t, c) = noise.innovation * normal(random);
      for (Index k = 0; k < std::min<Index>(t, noise.coefficients.size()); ++k) {
        x(t, c) += noise.coefficients[k] * x(t - 1 - k, c);
      }
    }
  }
  return x.bottomRows(samples);
}

TEST(Whitener, VarianceIsOneFromTheFirstSampleOnAndBehindGaps) {
  const AutoregressiveNoise noise = second_order();
  constexpr Index kSamples = 12, kDraws = 20000;
  VectorXd counted = VectorXd::Ones(kSamples);
  counted[5] = counted[6] = 0;
  MatrixXd x = drawn(noise, kSamples, kDraws);
  Whitener(noise).apply(x, counted);
  for (Index t = 0; t < kSamples; ++t) {
    const double variance = x.row(t).squaredNorm() / kDraws;
    EXPECT_NEAR(variance, counted[t], 5 * std::sqrt(2.0 / kDraws)) << "sample " << t;
  }
  // and no sample foretells the next
  for (const Index t : {1, 2, 3, 8, 9, 10}) {
    EXPECT_NEAR(x.row(t).dot(x.row(t - 1)) / kDraws, 0, 5 / std::sqrt(double{kDraws}));
  }
}

TEST(Whitener, OfWhiteNoiseIsADivision) {
  AutoregressiveNoise noise;
  noise.innovation = noise.deviation = 0.5;
  MatrixXd x = MatrixXd::Constant(4, 2, 3.0);
  Whitener(noise).apply(x, Eigen::Vector4d(1, 0, 1, 1));
  EXPECT_EQ(x.col(0), Eigen::Vector4d(6, 0, 6, 6));
  EXPECT_EQ(x.col(1), x.col(0));
}

}  // namespace
}  // namespace dyngen::runtime
