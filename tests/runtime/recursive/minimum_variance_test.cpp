// SPDX-License-Identifier: MIT
#include "runtime/recursive/minimum_variance.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "runtime/recursive/rls.h"
#include "tests/runtime/recursive/samples.h"

namespace dyngen::test {
namespace {

using runtime::MinimumVariance;
using runtime::MinimumVarianceOptions;

Eigen::MatrixXd random_covariance(std::mt19937_64& random, Eigen::Index size) {
  Eigen::MatrixXd root(size, size);
  for (Eigen::Index i = 0; i < size; ++i) root.col(i) = normal_vector(random, size);
  return root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(size, size);
}

TEST(MinimumVariance, IsRlsIfTheParametersDoNotWander) {
  for (const double prior : {1.0, 1e8}) {  // 1e8: cancellation would cost a plain C - K Y C
    const Samples samples = random_samples(1, 6, 52, 200, 0.5);
    runtime::RlsOptions rls_options;
    rls_options.noise_stddev = Eigen::VectorXd::Constant(6, 0.5);
    rls_options.prior_covariance = prior * Eigen::MatrixXd::Identity(52, 52);
    runtime::Rls rls(6, 52, rls_options);
    MinimumVarianceOptions options;
    options.prior_covariance = rls_options.prior_covariance;
    options.measurement_covariance = 0.25 * Eigen::MatrixXd::Identity(6, 6);
    MinimumVariance filter(options);
    for (Eigen::Index k = 0; k < samples.size(); ++k) {
      ASSERT_TRUE(rls.update(samples.Y(k), samples.torque(k)));
      ASSERT_TRUE(filter.update(samples.Y(k), samples.torque(k)));
      if (k < 20) continue;  // before, with the prior 1e8, beta hangs on rounding
      ASSERT_LT(relative_distance(filter.beta(), rls.beta()), 1e-9);
    }
    EXPECT_TRUE(filter.covariance().isApprox(rls.covariance(), 1e-9));
  }
}

TEST(MinimumVariance, IsTheFilterOfTheThesisWithFullCovariances) {
  const Samples samples = random_samples(2, 3, 8, 50, 0.5);
  std::mt19937_64 random(2);
  MinimumVarianceOptions options;
  options.prior_mean = normal_vector(random, 8);
  options.prior_covariance = random_covariance(random, 8);
  options.walk_covariance = 0.01 * random_covariance(random, 8);
  options.measurement_covariance = random_covariance(random, 3);
  MinimumVariance filter(options);
  Eigen::VectorXd beta = options.prior_mean;
  Eigen::MatrixXd C = options.prior_covariance;
  for (Eigen::Index k = 0; k < samples.size(); ++k) {
    if (k > 0) C += options.walk_covariance;
    const Eigen::MatrixXd Y = samples.W.middleRows(3 * k, 3);
    const Eigen::VectorXd e = samples.tau.segment(3 * k, 3) - Y * beta;
    const Eigen::MatrixXd S = Y * C * Y.transpose() + options.measurement_covariance;
    const Eigen::MatrixXd K = C * Y.transpose() * S.inverse();
    beta += K * e;
    C = (C - K * Y * C).eval();
    ASSERT_TRUE(filter.update(samples.Y(k), samples.torque(k)));
    ASSERT_LT(relative_distance(filter.beta(), beta), 1e-10);
    ASSERT_TRUE(filter.covariance().isApprox(C, 1e-10));
    const double squared = e.dot(S.ldlt().solve(e));
    ASSERT_NEAR(filter.innovation_squared(), squared, 1e-9 * squared);
  }
}

TEST(MinimumVariance, ErrorAndInnovationSquaredAreChiSquare) {
  constexpr unsigned kSeed = 3;
  constexpr int kRuns = 400, kSamples = 30;
  constexpr Eigen::Index kJoints = 2, kParameters = 6;
  std::printf("seed %u\n", kSeed);
  std::mt19937_64 random(kSeed);
  MinimumVarianceOptions options;
  options.prior_mean = normal_vector(random, kParameters);
  options.prior_covariance = random_covariance(random, kParameters);
  options.walk_covariance = 0.02 * random_covariance(random, kParameters);
  options.measurement_covariance = random_covariance(random, kJoints);
  const Eigen::MatrixXd prior = options.prior_covariance.llt().matrixL();
  const Eigen::MatrixXd walk = options.walk_covariance.llt().matrixL();
  const Eigen::MatrixXd noise = options.measurement_covariance.llt().matrixL();
  double error = 0, error_fourth = 0, innovation = 0;
  for (int run = 0; run < kRuns; ++run) {
    MinimumVariance filter(options);
    Eigen::VectorXd beta = options.prior_mean + prior * normal_vector(random, kParameters);
    for (int k = 0; k < kSamples; ++k) {
      if (k > 0) beta += walk * normal_vector(random, kParameters);
      runtime::RowMajorMatrix Y(kJoints, kParameters);
      for (Eigen::Index j = 0; j < kJoints; ++j) Y.row(j) = normal_vector(random, kParameters);
      const Eigen::VectorXd tau = Y * beta + noise * normal_vector(random, kJoints);
      ASSERT_TRUE(filter.update(Y.data(), tau.data()));
      innovation += filter.innovation_squared();
    }
    const Eigen::VectorXd difference = filter.beta() - beta;
    const double squared = difference.dot(filter.covariance().ldlt().solve(difference));
    error += squared;
    error_fourth += squared * squared;
  }
  // Chi-square with m degrees: mean m, variance 2 m, second moment m^2 + 2 m. Four standard
  // deviations of the means of as many draws (the second moment's variance: 8 m^3 + 40 m^2 + 48 m).
  const double m = kParameters, n = kJoints, runs = kRuns, draws = kRuns * kSamples;
  std::printf("mean squared error %.3f of %.0f, innovation %.3f of %.0f\n", error / runs, m,
              innovation / draws, n);
  EXPECT_NEAR(error / runs, m, 4 * std::sqrt(2 * m / runs));
  EXPECT_NEAR(error_fourth / runs, m * m + 2 * m,
              4 * std::sqrt((8 * m * m * m + 40 * m * m + 48 * m) / runs));
  EXPECT_NEAR(innovation / draws, n, 4 * std::sqrt(2 * n / draws));
}

TEST(MinimumVariance, FollowsAParameterThatWanders) {
  constexpr unsigned kSeed = 4;
  Samples samples = random_samples(kSeed, 2, 4, 2000, 0.1);
  std::mt19937_64 random(kSeed);
  Eigen::VectorXd beta = samples.beta;
  for (Eigen::Index k = 0; k < samples.size(); ++k) {
    beta[1] += 0.02 * normal_vector(random, 1)[0];
    samples.tau.segment(2 * k, 2) += samples.W.middleRows(2 * k, 2) * (beta - samples.beta);
  }
  MinimumVarianceOptions options;
  options.prior_covariance = Eigen::MatrixXd::Identity(4, 4);
  options.measurement_covariance = 0.01 * Eigen::MatrixXd::Identity(2, 2);
  MinimumVariance constant(options);
  options.walk_covariance = Eigen::Vector4d(0, 4e-4, 0, 0).asDiagonal();
  MinimumVariance walking(options);
  feed(constant, samples);
  feed(walking, samples);
  EXPECT_LT(std::abs(walking.beta()[1] - beta[1]), 0.15);
  EXPECT_LT(std::abs(walking.beta()[1] - beta[1]), std::abs(constant.beta()[1] - beta[1]));
}

TEST(MinimumVariance, CovarianceIsPositiveDefiniteAfterAMillionUpdates) {
  const Samples puma = puma3_samples(5, 1.0);
  MinimumVarianceOptions options;
  options.prior_covariance = 1e12 * Eigen::MatrixXd::Identity(15, 15);
  options.measurement_covariance = Eigen::MatrixXd::Identity(3, 3);
  MinimumVariance constant(options);
  options.walk_covariance = 1e-9 * Eigen::MatrixXd::Identity(15, 15);
  MinimumVariance walking(options);
  for (int round = 0; round < 10; ++round) {
    feed(constant, puma, kPassesOfARound);
    feed(walking, puma, kPassesOfARound);
    for (const Eigen::MatrixXd& P : {constant.covariance(), walking.covariance()}) {
      EXPECT_EQ((P - P.transpose()).cwiseAbs().maxCoeff(), 0);
      EXPECT_EQ(P.llt().info(), Eigen::Success);
    }
  }
  EXPECT_EQ(constant.samples(), 1000 * kPassesOfARound);
  const Eigen::MatrixXd P = (puma.W.transpose() * puma.W).inverse();
  EXPECT_TRUE((10.0 * kPassesOfARound * constant.covariance()).isApprox(P, 1e-8));
}

TEST(MinimumVarianceOptions, RefusesWhatCannotBe) {
  MinimumVarianceOptions good;
  good.prior_covariance = Eigen::MatrixXd::Identity(3, 3);
  good.measurement_covariance = Eigen::MatrixXd::Identity(2, 2);
  EXPECT_NO_THROW(MinimumVariance{good});
  EXPECT_THROW(MinimumVariance{MinimumVarianceOptions{}}, std::invalid_argument);
  MinimumVarianceOptions bad = good;
  bad.prior_covariance(0, 0) = -1;
  EXPECT_THROW(MinimumVariance{bad}, std::invalid_argument);
  bad = good;
  bad.measurement_covariance.setZero();
  EXPECT_THROW(MinimumVariance{bad}, std::invalid_argument);
  bad = good;
  bad.walk_covariance = -Eigen::MatrixXd::Identity(3, 3);
  EXPECT_THROW(MinimumVariance{bad}, std::invalid_argument);
  bad.walk_covariance = Eigen::MatrixXd::Identity(2, 2);
  EXPECT_THROW(MinimumVariance{bad}, std::invalid_argument);
  bad = good;
  bad.prior_mean.setZero(2);
  EXPECT_THROW(MinimumVariance{bad}, std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::test
