// SPDX-License-Identifier: MIT
#include "runtime/control/linearised_error.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr unsigned kSeed = 20261121;

MatrixXd random_matrix(std::mt19937_64& random, Index n) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return MatrixXd::NullaryExpr(n, n, [&] { return uniform(random); });
}

/// Of joints as different as bandwidths of 0.5 to 10 Hz and dampings of 0.3 to 1.5 make them.
Gains random_gains(std::mt19937_64& random, Index n) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Gains gains{VectorXd(n), VectorXd(n)};
  for (Index j = 0; j < n; ++j) {
    const Gains one =
        acceleration_gains(1, 0.5 + 9.5 * uniform(random), 0.3 + 1.2 * uniform(random));
    gains.kp[j] = one.kp[0];
    gains.kd[j] = one.kd[0];
  }
  return gains;
}

double two_norm(const MatrixXd& E) { return Eigen::JacobiSVD<MatrixXd>(E).singularValues()[0]; }
double slowest(const Gains& gains, const MatrixXd& E) {
  return error_eigenvalues(gains, E).real().maxCoeff();
}

TEST(InertiaError, IsZeroForTheTrueModelAndScales) {
  std::mt19937_64 random(kSeed);
  const MatrixXd A = random_matrix(random, 4);
  const MatrixXd M = A * A.transpose() + MatrixXd::Identity(4, 4);
  EXPECT_TRUE(inertia_error(M, M).isZero(1e-12));
  EXPECT_TRUE(inertia_error(M, 1.2 * M).isApprox(0.2 * MatrixXd::Identity(4, 4), 1e-10));
  EXPECT_THROW(inertia_error(-M, M), std::invalid_argument);
  EXPECT_THROW(inertia_error(M, MatrixXd::Identity(3, 3)), std::invalid_argument);
}

TEST(ErrorEigenvalues, AreThoseOfOscillatorsWithTheTrueModel) {
  const Gains gains = acceleration_gains(2, 1, 0.5);
  const double w = 2 * std::numbers::pi;
  for (const std::complex<double>& s : error_eigenvalues(gains, MatrixXd::Zero(2, 2))) {
    EXPECT_NEAR(s.real(), -w / 2, 1e-6);
    EXPECT_NEAR(std::abs(s.imag()), w * std::sqrt(0.75), 1e-6);
  }
}

TEST(InclusionRegions, HoldEveryEigenvalue) {
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> size(0, 1.5);
  int near_the_edge = 0;
  for (int k = 0; k < 3000; ++k) {
    const Index n = 1 + k % 7;
    const Gains gains = random_gains(random, n);
    const MatrixXd bound = size(random) * random_matrix(random, n).cwiseAbs();
    MatrixXd E = bound.cwiseProduct(random_matrix(random, n));
    if (k % 2 == 0) E = bound.cwiseProduct(random_matrix(random, n).cwiseSign());
    for (const std::complex<double>& s : error_eigenvalues(gains, E)) {
      const double margin = inclusion_margin(gains, bound, s);
      // the eigenvalues carry the rounding of a matrix whose entries are as large as kp
      const double scale = gains.kp.maxCoeff() + std::norm(s) + gains.kd.maxCoeff() * std::abs(s);
      EXPECT_GE(margin, -1e-7 * scale) << "case " << k;
      near_the_edge += static_cast<int>(margin < 0.05 * scale);
    }
  }
  EXPECT_GT(near_the_edge, 1000);  // the regions are not so large that they say nothing
}

TEST(InclusionRegions, LeaveTheRestOut) {
  const Gains gains = acceleration_gains(2, 1, 0.7);
  const MatrixXd bound = MatrixXd::Constant(2, 2, 0.05);
  EXPECT_LT(inclusion_margin(gains, bound, {0, 0}), 0);
  EXPECT_LT(inclusion_margin(gains, bound, {1, 3}), 0);
  EXPECT_GT(inclusion_margin(gains, bound, error_eigenvalues(gains, MatrixXd::Zero(2, 2))[0]), 0);
  EXPECT_THROW(inclusion_margin(gains, bound, 2, {0, 0}), std::invalid_argument);
  EXPECT_THROW(inclusion_margin(gains, MatrixXd::Zero(3, 3), {0, 0}), std::invalid_argument);
}

TEST(LargestSurvivedError, IsNeverViolated) {
  std::mt19937_64 random(kSeed);
  for (int k = 0; k < 3000; ++k) {
    const Index n = 1 + k % 7;
    const Gains gains = random_gains(random, n);
    MatrixXd E = random_matrix(random, n);
    E *= 0.999 * largest_survived_error(gains).norm / two_norm(E);
    EXPECT_LT(slowest(gains, E), 0) << "case " << k;
  }
}

TEST(LargestSurvivedError, IsReachedByARotation) {
  // p / c = -mu at the speed of the result: a rotation whose eigenvalue is mu oscillates there.
  for (const double damping : {0.2, 0.7, 1.0, 2.0}) {
    const Gains gains = acceleration_gains(2, 3, damping);
    const SurvivedError bound = largest_survived_error(gains);
    const std::complex<double> s(0, bound.speed);
    const std::complex<double> mu =
        -(s * s + gains.kd[0] * s + gains.kp[0]) / (gains.kd[0] * s + gains.kp[0]);
    EXPECT_NEAR(std::abs(mu), bound.norm, 1e-9);
    MatrixXd E(2, 2);
    E << mu.real(), -mu.imag(), mu.imag(), mu.real();
    EXPECT_NEAR(slowest(gains, E), 0, 1e-6 * bound.speed);
    EXPECT_LT(slowest(gains, 0.99 * E), 0);
    EXPECT_GT(slowest(gains, 1.01 * E), 0);
  }
}

TEST(LargestSurvivedError, CriticalDampingSurvives87PerCent) {
  // |T| = |(2 w s + w^2) / (s + w)^2| is largest at s = i w / sqrt(2): 2 / sqrt(3)
  const SurvivedError bound = largest_survived_error(acceleration_gains(3, 5, 1));
  EXPECT_NEAR(bound.norm, std::sqrt(3) / 2, 1e-12);
  EXPECT_NEAR(bound.speed, 10 * std::numbers::pi / std::sqrt(2), 1e-9);
}

TEST(GuaranteedDecay, IsNeverViolated) {
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> share(0, 1);
  int close = 0;
  for (int k = 0; k < 3000; ++k) {
    const Index n = 1 + k % 7;
    const Gains gains = random_gains(random, n);
    const double norm = share(random) * largest_survived_error(gains).norm;
    MatrixXd E = random_matrix(random, n);
    E *= norm / two_norm(E);
    const double decay = guaranteed_decay(gains, norm);
    EXPECT_LE(slowest(gains, E), -decay + 1e-6 * gains.kd.maxCoeff()) << "case " << k;
    close += static_cast<int>(slowest(gains, E) > -1.3 * decay);
  }
  EXPECT_GT(close, 100);
}

TEST(GuaranteedDecay, IsTheSlowestRootWithoutError) {
  // a double root of the square: half of the digits
  EXPECT_NEAR(guaranteed_decay(acceleration_gains(2, 1, 0.5), 0), std::numbers::pi, 1e-6);
  const double w = 2 * std::numbers::pi;
  EXPECT_NEAR(guaranteed_decay(acceleration_gains(2, 1, 2), 0), w * (2 - std::sqrt(3)), 1e-6);
  EXPECT_EQ(guaranteed_decay(acceleration_gains(2, 1, 1), 0.9), 0);
  EXPECT_THROW(guaranteed_decay(acceleration_gains(2, 1, 1), -1), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
