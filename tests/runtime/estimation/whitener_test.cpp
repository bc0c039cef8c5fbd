// SPDX-License-Identifier: MIT
#include "runtime/estimation/whitener.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
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
  Whitener({noise, {}}, counted).apply(x);
  for (Index t = 0; t < kSamples; ++t) {
    const double variance = x.row(t).squaredNorm() / kDraws;
    EXPECT_NEAR(variance, counted[t], 5 * std::sqrt(2.0 / kDraws)) << "sample " << t;
  }
  // and no sample foretells the next
  for (const Index t : {1, 2, 3, 8, 9, 10}) {
    EXPECT_NEAR(x.row(t).dot(x.row(t - 1)) / kDraws, 0, 5 / std::sqrt(double{kDraws}));
  }
}

/// Covariance of all samples of a run.
MatrixXd covariance_of(const JointNoise& noise, Index samples) {
  const VectorXd quick = autocovariance(noise.quick, samples - 1);
  MatrixXd covariance(samples, samples);
  for (Index i = 0; i < samples; ++i) {
    for (Index j = 0; j < samples; ++j) {
      const auto lag = static_cast<double>(std::abs(i - j));
      covariance(i, j) = quick[std::abs(i - j)];
      for (const SlowNoise& part : noise.slow) {
        covariance(i, j) += part.deviation * part.deviation * std::pow(part.pole, lag);
      }
    }
  }
  return covariance;
}

TEST(Whitener, LeavesNothingOfACovarianceWithSlowPartsAndGaps) {
  constexpr Index kSamples = 90;
  const JointNoise noise{second_order(), {{0, 0.3}, {0.97, 0.4}, {0.999, 0.8}}};
  VectorXd counted = VectorXd::Ones(kSamples);
  counted.segment(0, 3).setZero();
  counted.segment(40, 7).setZero();
  counted[70] = 0;
  // the columns of a triangle of the covariance, whitened, have orthonormal rows
  MatrixXd columns = covariance_of(noise, kSamples).llt().matrixL();
  Whitener(noise, counted).apply(columns);
  const MatrixXd expected = counted.asDiagonal();
  EXPECT_LT((columns * columns.transpose() - expected).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(JointNoise, DensityIsTheSumOfTheAutocovariance) {
  const JointNoise noise{second_order(), {{0.9, 0.4}}};
  constexpr Index kLags = 400;
  const MatrixXd covariance = covariance_of(noise, kLags + 1);
  EXPECT_NEAR(noise.deviation(), std::sqrt(covariance(0, 0)), 1e-12);
  for (const double frequency : {0.0, 0.03, 0.2, 0.5}) {
    double sum = covariance(0, 0);
    for (Index lag = 1; lag <= kLags; ++lag) {
      sum += 2 * covariance(0, lag) * std::cos(2 * M_PI * frequency * static_cast<double>(lag));
    }
    EXPECT_NEAR(noise.density(frequency), sum, 1e-9 * sum);
  }
}

TEST(Whitener, AColumnDoesNotDependOnHowManyThereAre) {
  VectorXd counted = VectorXd::Ones(60);
  counted.segment(20, 3).setZero();
  const JointNoise noise{second_order(), {{0.97, 0.2}}};
  const Whitener whitener(noise, counted);
  const MatrixXd x = drawn(second_order(), 60, 71);
  MatrixXd alone = x;
  for (Index c = 0; c < x.cols(); ++c) whitener.apply(alone.col(c));
  for (const Index count : {2, 8, 9, 16, 17, 32, 33, 71}) {
    MatrixXd together = x.leftCols(count);
    whitener.apply(together);
    EXPECT_EQ(together, alone.leftCols(count)) << count << " columns";
  }
}

TEST(Whitener, OfWhiteNoiseIsADivision) {
  AutoregressiveNoise noise;
  noise.innovation = noise.deviation = 0.5;
  MatrixXd x = MatrixXd::Constant(4, 2, 3.0);
  Whitener({noise, {}}, Eigen::Vector4d(1, 0, 1, 1)).apply(x);
  EXPECT_EQ(x.col(0), Eigen::Vector4d(6, 0, 6, 6));
  EXPECT_EQ(x.col(1), x.col(0));
}

}  // namespace
}  // namespace dyngen::runtime
