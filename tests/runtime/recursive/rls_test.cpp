// SPDX-License-Identifier: MIT
#include "runtime/recursive/rls.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <stdexcept>

#include "tests/runtime/recursive/samples.h"

namespace dyngen::test {
namespace {

using runtime::Rls;
using runtime::RlsOptions;

Eigen::VectorXd least_squares(const Eigen::MatrixXd& W, const Eigen::VectorXd& tau) {
  return W.colPivHouseholderQr().solve(tau);
}

TEST(Rls, IsBatchLeastSquares) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Samples samples = random_samples(seed, 6, 52, 200, 0.5);
    Rls rls(6, 52);
    EXPECT_EQ(feed(rls, samples), 200);
    EXPECT_LT(relative_distance(rls.beta(), least_squares(samples.W, samples.tau)), 1e-9);
    const Eigen::MatrixXd P = (samples.W.transpose() * samples.W).inverse();
    EXPECT_TRUE(rls.covariance().isApprox(P, 1e-9));
  }
  const Samples puma = puma3_samples(4, 1.0);
  Rls rls(3, 15);
  feed(rls, puma);
  EXPECT_LT(relative_distance(rls.beta(), least_squares(puma.W, puma.tau)), 1e-9);
}

TEST(Rls, WeighsJointsByTheirNoise) {
  const Samples samples = random_samples(5, 3, 10, 60, 0.5);
  RlsOptions options;
  options.noise_stddev = Eigen::Vector3d(0.1, 2, 30);
  Rls rls(3, 10, options);
  feed(rls, samples);
  Eigen::MatrixXd W = samples.W;
  Eigen::VectorXd tau = samples.tau;
  for (Eigen::Index row = 0; row < W.rows(); ++row) {
    W.row(row) /= options.noise_stddev[row % 3];
    tau[row] /= options.noise_stddev[row % 3];
  }
  EXPECT_LT(relative_distance(rls.beta(), least_squares(W, tau)), 1e-9);
}

TEST(Rls, WithAPriorIsRidgeRegression) {
  const Samples samples = random_samples(6, 2, 12, 4, 0.5);  // fewer equations than parameters
  std::mt19937_64 random(6);
  Eigen::MatrixXd root(12, 12);
  for (Eigen::Index i = 0; i < 12; ++i) root.col(i) = normal_vector(random, 12);
  RlsOptions options;
  options.prior_mean = normal_vector(random, 12);
  options.prior_covariance = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(12, 12);
  Rls rls(2, 12, options);
  EXPECT_TRUE(rls.covariance().isApprox(options.prior_covariance, 1e-9));
  feed(rls, samples);
  const Eigen::MatrixXd information =
      samples.W.transpose() * samples.W + options.prior_covariance.inverse();
  const Eigen::VectorXd ridge =
      options.prior_mean + information.ldlt().solve(samples.W.transpose() *
                                                    (samples.tau - samples.W * options.prior_mean));
  EXPECT_LT(relative_distance(rls.beta(), ridge), 1e-9);
  EXPECT_TRUE(rls.covariance().isApprox(information.inverse(), 1e-9));
}

TEST(Rls, ForgettingWeighsOldSamplesLess) {
  const Samples samples = random_samples(7, 2, 6, 100, 1.0);
  RlsOptions options;
  options.forgetting = 0.9;
  Rls rls(2, 6, options);
  feed(rls, samples);
  Eigen::MatrixXd W = samples.W;
  Eigen::VectorXd tau = samples.tau;
  for (Eigen::Index row = 0; row < W.rows(); ++row) {
    const double weight = std::pow(0.9, 0.5 * static_cast<double>(99 - row / 2));
    W.row(row) *= weight;
    tau[row] *= weight;
  }
  EXPECT_LT(relative_distance(rls.beta(), least_squares(W, tau)), 1e-9);
}

TEST(Rls, ForgettingFollowsAParameterThatJumps) {
  Samples samples = random_samples(8, 2, 6, 400, 0.05);
  samples.tau.tail(400) += 3.0 * samples.W.col(4).tail(400);  // beta_4 += 3 at sample 200
  Rls constant(2, 6);
  RlsOptions options;
  options.forgetting = 0.95;
  Rls forgetful(2, 6, options);
  feed(constant, samples);
  feed(forgetful, samples);
  EXPECT_NEAR(forgetful.beta()[4], samples.beta[4] + 3, 0.1);
  EXPECT_GT(std::abs(constant.beta()[4] - samples.beta[4] - 3), 1);
}

TEST(Rls, StaysAtThePriorMeanUntilEveryParameterIsDetermined) {
  const Samples samples = random_samples(9, 2, 6, 3, 0);
  RlsOptions options;
  options.prior_mean = Eigen::VectorXd::Ones(6);
  Rls rls(2, 6, options);
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_FALSE(rls.determined());
    EXPECT_TRUE(std::isnan(rls.covariance()(0, 0)));
    EXPECT_EQ(rls.beta(), options.prior_mean);
    EXPECT_TRUE(rls.update(samples.Y(k), samples.torque(k)));
  }
  EXPECT_TRUE(rls.determined());
  EXPECT_LT(relative_distance(rls.beta(), samples.beta), 1e-9);
}

TEST(Rls, HoldsWhatIsNoLongerExcitedAndFindsItAgain) {
  const Samples samples = random_samples(10, 2, 6, 100, 0.01);
  RlsOptions options;
  options.forgetting = 0.99;
  Rls rls(2, 6, options);
  feed(rls, samples);
  // The arm rests for so long that all other information is forgotten.
  for (int k = 0; k < 100000; ++k) ASSERT_TRUE(rls.update(samples.Y(0), samples.torque(0)));
  EXPECT_FALSE(rls.determined());
  EXPECT_LT(relative_distance(rls.beta(), samples.beta), 0.1);
  feed(rls, samples);
  EXPECT_TRUE(rls.determined());
  EXPECT_LT(relative_distance(rls.beta(), samples.beta), 0.01);
}

TEST(Rls, NoStandardDeviationPassesItsBoundAtRest) {
  const Samples samples = random_samples(12, 2, 6, 100, 0.01);
  RlsOptions options;
  options.forgetting = 0.99;
  options.max_stddev = Eigen::VectorXd::LinSpaced(6, 0.5, 3);
  Rls rls(2, 6, options);
  feed(rls, samples);
  const Eigen::VectorXd moving = rls.beta();
  for (int k = 0; k < 20000; ++k) {
    ASSERT_TRUE(rls.update(samples.Y(0), samples.torque(0)));
    if (k % 97 != 0) continue;
    const Eigen::VectorXd stddev = rls.covariance().diagonal().cwiseSqrt();
    EXPECT_LE((stddev.cwiseQuotient(options.max_stddev)).maxCoeff(), 1 + 1e-9);
  }
  EXPECT_LT(relative_distance(rls.beta(), moving), 0.05);
}

void expect_positive(const Eigen::MatrixXd& P) {
  EXPECT_EQ((P - P.transpose()).cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(P.llt().info(), Eigen::Success);
}

TEST(Rls, CovarianceIsPositiveDefiniteAfterAMillionUpdates) {
  const Samples puma = puma3_samples(13, 1.0);
  RlsOptions options;
  options.prior_covariance = 1e12 * Eigen::MatrixXd::Identity(15, 15);  // hardly anything is known
  Rls constant(3, 15, options);
  options.forgetting = 0.999;
  Rls forgetful(3, 15, options);
  for (int round = 0; round < 10; ++round) {
    feed(constant, puma, kPassesOfARound);
    feed(forgetful, puma, kPassesOfARound);
    expect_positive(constant.covariance());
    expect_positive(forgetful.covariance());
  }
  EXPECT_EQ(constant.samples(), 1000 * kPassesOfARound);
  // The same 100 samples again and again: the estimate is theirs, the covariance a fraction of it.
  const Eigen::MatrixXd P = (puma.W.transpose() * puma.W).inverse();
  EXPECT_LT(relative_distance(constant.beta(), least_squares(puma.W, puma.tau)), 1e-9);
  EXPECT_TRUE((10.0 * kPassesOfARound * constant.covariance()).isApprox(P, 1e-8));
}

TEST(RlsOptions, RefusesWhatCannotBe) {
  const auto with = [](auto change) {
    RlsOptions options;
    change(options);
    return options;
  };
  EXPECT_NO_THROW(Rls(2, 3));
  EXPECT_THROW(Rls(0, 3), std::invalid_argument);
  EXPECT_THROW(Rls(2, 0), std::invalid_argument);
  for (const double forgetting : {0.0, -1.0, 1.1, std::nan("")}) {
    EXPECT_THROW(Rls(2, 3, with([&](RlsOptions& o) { o.forgetting = forgetting; })),
                 std::invalid_argument);
  }
  EXPECT_THROW(Rls(2, 3, with([](RlsOptions& o) { o.noise_stddev.setZero(2); })),
               std::invalid_argument);
  EXPECT_THROW(Rls(2, 3, with([](RlsOptions& o) { o.prior_mean.setZero(2); })),
               std::invalid_argument);
  EXPECT_THROW(Rls(2, 3, with([](RlsOptions& o) { o.prior_covariance.setZero(3, 3); })),
               std::invalid_argument);
  EXPECT_THROW(Rls(2, 3, with([](RlsOptions& o) { o.prior_covariance.setIdentity(2, 2); })),
               std::invalid_argument);
  EXPECT_THROW(Rls(2, 3, with([](RlsOptions& o) { o.max_stddev.setConstant(3, -1); })),
               std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::test
