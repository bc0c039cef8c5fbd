// SPDX-License-Identifier: MIT
#include "runtime/signals/butterworth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

constexpr double kT = 1e-3;

Eigen::MatrixXd sine(double hz, Eigen::Index N) {
  Eigen::MatrixXd x(N, 1);
  for (Eigen::Index k = 0; k < N; ++k) {
    x(k, 0) = std::sin(2 * std::numbers::pi * hz * kT * static_cast<double>(k));
  }
  return x;
}

/// Gain and phase of the middle of y on the sine it came from, by least squares.
std::complex<double> response(const Eigen::MatrixXd& y, double hz) {
  const Eigen::Index N = y.rows(), edge = N / 3;
  Eigen::MatrixXd basis(N - 2 * edge, 2);
  for (Eigen::Index k = 0; k < basis.rows(); ++k) {
    const double angle = 2 * std::numbers::pi * hz * kT * static_cast<double>(k + edge);
    basis(k, 0) = std::sin(angle);
    basis(k, 1) = std::cos(angle);
  }
  const Eigen::Matrix2d normal = basis.transpose() * basis;
  const Eigen::Vector2d side = basis.transpose() * y.col(0).segment(edge, basis.rows());
  const double det = normal(0, 0) * normal(1, 1) - normal(0, 1) * normal(1, 0);
  return {(normal(1, 1) * side[0] - normal(0, 1) * side[1]) / det,
          (normal(0, 0) * side[1] - normal(1, 0) * side[0]) / det};
}

TEST(Butterworth, GainIsHalfAtTheCutoffAndPhaseIsZero) {
  for (int order = 1; order <= 8; ++order) {
    const LowPass filter = design_butterworth(order, 30, kT);
    const auto at = response(zero_phase(filter, sine(30, 6000)), 30);
    EXPECT_NEAR(at.real(), 0.5, 1e-10) << order;
    EXPECT_NEAR(at.imag(), 0, 1e-9) << order;
  }
}

TEST(Butterworth, GainFollowsThePrewarpedPrototype) {
  for (const int order : {1, 2, 3, 4, 7, 8}) {
    const LowPass filter = design_butterworth(order, 50, kT);
    for (const double hz : {3.0, 20.0, 45.0, 80.0, 200.0}) {
      const double warped =
          std::tan(std::numbers::pi * hz * kT) / std::tan(std::numbers::pi * 50 * kT);
      const auto got = response(zero_phase(filter, sine(hz, 6000)), hz);
      EXPECT_NEAR(got.real(), 1 / (1 + std::pow(warped, 2 * order)), 1e-9) << order << " " << hz;
      EXPECT_NEAR(std::arg(got) * std::abs(got), 0, 1e-9) << order << " " << hz;
    }
  }
}

TEST(Butterworth, ALinePassesExactly) {
  for (const int order : {1, 4, 5, 8}) {
    for (const Eigen::Index N : {1, 2, 5, 40, 3000}) {
      Eigen::MatrixXd line(N, 2);
      for (Eigen::Index k = 0; k < N; ++k) {
        line(k, 0) = 3 - 0.01 * static_cast<double>(k);
        line(k, 1) = 2;
      }
      const Eigen::MatrixXd y = zero_phase(design_butterworth(order, 2, kT), line);
      // Rounding of the line's slope is carried over the padding.
      EXPECT_LT((y - line).cwiseAbs().maxCoeff(), 1e-9) << order << " " << N;
    }
  }
}

TEST(Butterworth, ImpulseResponseHasDecayedWhenItSaysSo) {
  for (const int order : {1, 2, 4, 8}) {
    const LowPass filter = design_butterworth(order, 10, kT);
    for (const double tolerance : {1e-2, 1e-9}) {
      const Eigen::Index settled = settling_samples(filter, tolerance);
      Eigen::VectorXd x = Eigen::VectorXd::Zero(3 * settled);
      x[0] = 1;
      PassState state{};
      pass_forward(filter, state, x.data(), x.size());
      const double peak = x.cwiseAbs().maxCoeff();
      EXPECT_LE(x.tail(2 * settled).cwiseAbs().maxCoeff(), tolerance * peak);
      EXPECT_GT(std::abs(x[settled - 1]), tolerance * peak);
    }
  }
}

TEST(Butterworth, CutoffOutsideTheRangeIsRefused) {
  EXPECT_THROW(design_butterworth(4, 0, kT), std::invalid_argument);
  EXPECT_THROW(design_butterworth(4, 500, kT), std::invalid_argument);
  EXPECT_THROW(design_butterworth(4, std::nan(""), kT), std::invalid_argument);
  EXPECT_THROW(design_butterworth(0, 10, kT), std::invalid_argument);
  EXPECT_THROW(design_butterworth(9, 10, kT), std::invalid_argument);
  EXPECT_THROW(design_butterworth(4, 10, 0), std::invalid_argument);
  EXPECT_THROW(settling_samples(design_butterworth(4, 10, kT), 0), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
