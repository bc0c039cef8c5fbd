// SPDX-License-Identifier: MIT
#include "runtime/signals/spectral.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

TEST(Spectral, AFiniteFourierSeriesIsDifferentiatedExactly) {
  for (const Eigen::Index N : {1000, 1024, 1009, 5001}) {
    const double T = 10.0 / static_cast<double>(N);  // a period of 10 s
    Eigen::MatrixXd q = Eigen::MatrixXd::Zero(N, 2), dq = q, ddq = q;
    for (Eigen::Index k = 0; k < N; ++k) {
      for (int j = 0; j < 2; ++j) {
        q(k, j) = 0.4 + j;
        for (int line = 1; line <= 5; ++line) {
          const double w = 2 * std::numbers::pi * 0.1 * line, amplitude = 0.5 / (line + j);
          const double angle = w * T * static_cast<double>(k) + line * line;
          q(k, j) += amplitude * std::cos(angle);
          dq(k, j) -= amplitude * w * std::sin(angle);
          ddq(k, j) -= amplitude * w * w * std::cos(angle);
        }
      }
    }
    const SpectralStates states = spectral_derivatives(q, T, line_below(0.5, N, T));
    EXPECT_LT((states.position - q).norm(), 1e-12 * q.norm()) << N;
    EXPECT_LT((states.velocity - dq).norm(), 1e-10 * dq.norm()) << N;
    EXPECT_LT((states.acceleration - ddq).norm(), 1e-10 * ddq.norm()) << N;
  }
}

TEST(Spectral, ACutoffFindsItsLine) {
  EXPECT_EQ(line_below(0.5, 1000, 0.01), 5);
  EXPECT_EQ(line_below(0.49, 1000, 0.01), 4);
  EXPECT_EQ(line_below(1e6, 1000, 0.01), 499);
  EXPECT_EQ(line_below(1e6, 1001, 0.01), 500);
  EXPECT_EQ(line_below(1, 1, 0.01), 0);
}

TEST(Spectral, LinesAboveHalfOfTheSamplesAreRefused) {
  EXPECT_THROW(spectral_derivatives(Eigen::MatrixXd::Zero(10, 1), 0.1, 5), std::invalid_argument);
  EXPECT_THROW(spectral_derivatives(Eigen::MatrixXd::Zero(10, 1), 0.1, -1), std::invalid_argument);
  EXPECT_THROW(spectral_derivatives(Eigen::MatrixXd::Zero(0, 1), 0.1, 0), std::invalid_argument);
  EXPECT_THROW(spectral_derivatives(Eigen::MatrixXd::Zero(10, 1), 0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
