// SPDX-License-Identifier: MIT
#include "runtime/signals/kalman_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <iostream>
#include <random>
#include <stdexcept>
#include <vector>

namespace dyngen::runtime {
namespace {

constexpr unsigned kSeed = 20260;

Eigen::Matrix3d transition(double T) {
  Eigen::Matrix3d A;
  A << 1, T, T * T / 2, 0, 1, T, 0, 0, 1;
  return A;
}

/// As the thesis prints it, (4.4).
Eigen::Matrix3d process_noise(double T, double q) {
  Eigen::Matrix3d Q;
  Q << std::pow(T, 5) / 20, std::pow(T, 4) / 8, std::pow(T, 3) / 6,  //
      std::pow(T, 4) / 8, std::pow(T, 3) / 3, T * T / 2,             //
      std::pow(T, 3) / 6, T * T / 2, T;
  return q * Q;
}

struct Simulation {
  Eigen::MatrixXd truth;  // (N x 3)
  Eigen::VectorXd y;
};

Simulation simulate(Eigen::Index N, double T, const KalmanOptions& options, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::Matrix3d A = transition(T);
  const Eigen::Matrix3d root = process_noise(T, options.jerk_intensity).llt().matrixL();
  Simulation result{Eigen::MatrixXd(N, 3), Eigen::VectorXd(N)};
  Eigen::Vector3d x(0.3, -1, 2);
  for (Eigen::Index k = 0; k < N; ++k) {
    result.truth.row(k) = x.transpose();
    result.y[k] = x[0] + std::sqrt(options.measurement_variance) * normal(random);
    const Eigen::Vector3d noise(normal(random), normal(random), normal(random));
    x = A * x + root * noise;
  }
  return result;
}

TEST(KalmanFilter, EqualsTheTextbookFilterWithAVeryWidePrior) {
  const double T = 0.01;
  const KalmanOptions options{1e3, 1e-6};
  const Simulation run = simulate(400, T, options, kSeed);
  const Eigen::Matrix3d A = transition(T), Q = process_noise(T, options.jerk_intensity);
  Eigen::Matrix3d P = Eigen::Vector3d(1e2, 1e4, 1e6).asDiagonal();
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  const KalmanStates got = kalman_filter(run.y, T, options);
  for (Eigen::Index k = 0; k < run.y.size(); ++k) {
    if (k > 0) {
      x = A * x;
      P = A * P * A.transpose() + Q;
    }
    const Eigen::Vector3d K = P.col(0) / (P(0, 0) + options.measurement_variance);
    x += K * (run.y[k] - x[0]);
    P -= K * P.row(0);
    P = (0.5 * (P + P.transpose())).eval();
    if (k < 2) continue;
    // The textbook's prior is finite and rounds the first covariances; both are forgotten.
    const double tolerance = k < 60 ? 1e-3 : 1e-8;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(got.states(k, i), x[i], tolerance * std::sqrt(P(i, i))) << k << " " << i;
      EXPECT_NEAR(got.variances(k, i), P(i, i), tolerance * P(i, i)) << k << " " << i;
    }
  }
  const Eigen::Vector3d K = P.col(0) / options.measurement_variance;  // (4.6)
  const Eigen::Vector3d gain = steady_gain(T, options);
  EXPECT_LT((gain - K).cwiseQuotient(K).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(KalmanFilter, SmootherIsTheLeastSquaresSolution) {
  // Of all states at once: e^2/R + w^T Q^-1 w least, no prior.
  const double T = 0.01;
  const KalmanOptions options{5e2, 1e-6};
  for (const Eigen::Index N : {3, 4, 5, 25}) {
    const Simulation run = simulate(N, T, options, kSeed + 1);
    Eigen::MatrixXd scale = Eigen::Vector3d(1, 1 / T, 1 / (T * T)).asDiagonal();
    const Eigen::Matrix3d A = scale.inverse() * transition(T) * scale;
    const Eigen::Matrix3d information =
        (scale.inverse() * process_noise(T, options.jerk_intensity) * scale.inverse()).inverse();
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(3 * N, 3 * N);
    Eigen::VectorXd side = Eigen::VectorXd::Zero(3 * N);
    for (Eigen::Index k = 0; k < N; ++k) {
      normal(3 * k, 3 * k) += 1 / options.measurement_variance;
      side[3 * k] += run.y[k] / options.measurement_variance;
      if (k + 1 == N) break;
      Eigen::Matrix<double, 3, 6> flow;
      flow << -A, Eigen::Matrix3d::Identity();
      normal.block<6, 6>(3 * k, 3 * k) += flow.transpose() * information * flow;
    }
    const Eigen::MatrixXd covariance = normal.inverse();
    const Eigen::VectorXd x = covariance * side;
    const KalmanStates got = kalman_smoother(run.y, T, options);
    for (Eigen::Index k = 0; k < N; ++k) {
      for (int i = 0; i < 3; ++i) {
        const double variance = covariance(3 * k + i, 3 * k + i) * scale(i, i) * scale(i, i);
        EXPECT_NEAR(got.variances(k, i), variance, 1e-5 * variance) << N << " " << k << " " << i;
        EXPECT_NEAR(got.states(k, i), x[3 * k + i] * scale(i, i), 1e-4 * std::sqrt(variance))
            << N << " " << k << " " << i;
      }
    }
  }
}

TEST(KalmanFilter, ErrorsAreAsLargeAsTheStatedVariancesAndTheSmoothersAreSmaller) {
  const double T = 1e-3;
  const KalmanOptions options{1e3, encoder_variance(1e-4)};
  // Samples far apart are independent: 60 runs x 20 samples; chi-square with 1200 degrees of
  // freedom.
  constexpr int kRuns = 60;
  constexpr Eigen::Index kSamples = 20, kApart = 400;
  std::cout << "seed " << kSeed << "\n";
  Eigen::Array3d filter = Eigen::Array3d::Zero(), smoother = filter;
  Eigen::Array3d filter_error = filter, smoother_error = filter;
  for (unsigned r = 0; r < kRuns; ++r) {
    const Simulation run = simulate((kSamples + 1) * kApart, T, options, kSeed + r);
    const KalmanStates forward = kalman_filter(run.y, T, options);
    const KalmanStates both = kalman_smoother(run.y, T, options);
    for (Eigen::Index s = 0; s < kSamples; ++s) {
      const Eigen::Index k = kApart / 2 + s * kApart;
      const Eigen::Array3d f = (forward.states.row(k) - run.truth.row(k)).transpose().array();
      const Eigen::Array3d b = (both.states.row(k) - run.truth.row(k)).transpose().array();
      filter += f.square() / forward.variances.row(k).transpose().array();
      smoother += b.square() / both.variances.row(k).transpose().array();
      filter_error += f.square();
      smoother_error += b.square();
    }
  }
  const double count = static_cast<double>(kRuns * kSamples);
  const double band = 4 * std::sqrt(2 * count);  // 4 standard deviations
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(filter[i], count, band) << i;
    EXPECT_NEAR(smoother[i], count, band) << i;
    EXPECT_LT(smoother_error[i], 0.7 * filter_error[i]) << i;
  }
}

TEST(KalmanFilter, FindsTheIntensityOfASimulation) {
  std::cout << "seed " << kSeed << "\n";
  for (const double q : {1.0, 1e3, 1e6}) {
    for (const double deviation : {1e-6, 1e-4}) {
      const double T = 1e-3;
      const KalmanOptions truth{q, deviation * deviation};
      const Simulation run = simulate(8000, T, truth, kSeed);
      const KalmanOptions found = choose_kalman_options(run.y, T);
      EXPECT_NEAR(std::log(found.jerk_intensity / q), 0, std::log(3.0)) << q << " " << deviation;
      EXPECT_NEAR(found.measurement_variance / truth.measurement_variance, 1, 0.2);
      EXPECT_NEAR(std::log(choose_jerk_intensity(run.y, T, truth.measurement_variance) / q), 0,
                  std::log(3.0));
      EXPECT_EQ(choose_jerk_intensity(run.y, T), found.jerk_intensity);
    }
  }
}

TEST(KalmanFilter, APolynomialIsFollowedFromTheFirstSample) {
  const double T = 1e-3;
  Eigen::VectorXd y(500);
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    const double t = T * static_cast<double>(k);
    y[k] = 1 + 2 * t + 1.5 * t * t;
  }
  for (const auto& got : {kalman_filter(y, T, {1e3, 1e-10}), kalman_smoother(y, T, {1e3, 1e-10})}) {
    EXPECT_LT((got.states.col(0) - y).cwiseAbs().maxCoeff(), 1e-12);
    // Rounding of the first samples over T and T^2.
    EXPECT_LT((got.states.col(2).array() - 3).abs().maxCoeff(), 1e-8);
    for (Eigen::Index k = 0; k < y.size(); ++k) {
      EXPECT_NEAR(got.states(k, 1), 2 + 3 * T * static_cast<double>(k), 1e-10);
    }
  }
}

TEST(KalmanFilter, SixJointsOfAHundredThousandSamplesTakeLessThanASecond) {
  const KalmanOptions options{1e3, 1e-12};
  const Simulation run = simulate(100'000, 2e-4, options, kSeed);
  const auto begin = std::chrono::steady_clock::now();
  double sum = 0;
  for (int joint = 0; joint < 6; ++joint) {
    sum += kalman_smoother(run.y, 2e-4, options).states(5000, 1);
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  EXPECT_TRUE(std::isfinite(sum));
  std::cout << taken.count() << " s\n";
#if defined(NDEBUG) && defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
  EXPECT_LT(taken.count(), 1);
#endif
}

TEST(KalmanFilter, NonsenseIsRefusedAndRestIsZero) {
  const Eigen::VectorXd y = Eigen::VectorXd::Constant(10, 0.5);
  EXPECT_THROW(kalman_filter(y, 1e-3, {0, 1}), std::invalid_argument);
  EXPECT_THROW(kalman_filter(y, 1e-3, {1, -1}), std::invalid_argument);
  EXPECT_THROW(kalman_smoother(y, 0, {1, 1}), std::invalid_argument);
  EXPECT_THROW(kalman_smoother(y.head(2), 1e-3, {1, 1}), std::invalid_argument);
  EXPECT_EQ(choose_jerk_intensity(y, 1e-3), 0);
  EXPECT_EQ(choose_jerk_intensity(y, 1e-3, 1e-6), 0);
}

}  // namespace
}  // namespace dyngen::runtime
