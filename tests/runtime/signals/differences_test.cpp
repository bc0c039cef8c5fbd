// SPDX-License-Identifier: MIT
#include "runtime/signals/differences.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "runtime/signals/low_pass_state.h"

namespace dyngen::runtime {
namespace {

TEST(Differences, AParabolaIsDifferentiatedExactlyUpToItsEnds) {
  const double T = 0.01;
  const Eigen::Index N = 50;
  Eigen::MatrixXd x(N, 2), velocity(N, 2), acceleration(N, 2);
  for (Eigen::Index k = 0; k < N; ++k) {
    const double t = T * static_cast<double>(k);
    x.row(k) << 1 + 2 * t, 0.5 - 3 * t + 4 * t * t;
    velocity.row(k) << 2, -3 + 8 * t;
    acceleration.row(k) << 0, 8;
  }
  // Rounding: 1e-16 of the position over T, over T^2.
  EXPECT_LT((first_difference(x, T) - velocity).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((second_difference(x, T) - acceleration).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Differences, TooFewSamplesAreRefused) {
  EXPECT_THROW(first_difference(Eigen::MatrixXd(2, 1), 0.01), std::invalid_argument);
  EXPECT_THROW(second_difference(Eigen::MatrixXd(3, 1), 0.01), std::invalid_argument);
  EXPECT_THROW(first_difference(Eigen::MatrixXd(5, 1), 0), std::invalid_argument);
}

TEST(WideDifferences, DifferencesAreExactForPolynomialsOfTheTenthDegree) {
  // x^10 + x^9 at 0.3 with samples 0.01 apart: derivatives by hand, rounding grows as 1/T and 1/T^2
  constexpr double kStep = 0.01, kAt = 0.3;
  std::array<double, 2 * kDifferenceReach + 1> values{};
  const auto x = [](Eigen::Index i) { return kAt + kStep * static_cast<double>(i); };
  for (Eigen::Index i = -kDifferenceReach; i <= kDifferenceReach; ++i) {
    values[static_cast<std::size_t>(i + kDifferenceReach)] = std::pow(x(i), 10) + std::pow(x(i), 9);
  }
  const double* const middle = values.data() + kDifferenceReach;
  const double first = 10 * std::pow(kAt, 9) + 9 * std::pow(kAt, 8);
  const double second = 90 * std::pow(kAt, 8) + 72 * std::pow(kAt, 7);
  EXPECT_NEAR(wide_first_difference(middle, kStep), first, 1e-12);
  EXPECT_NEAR(wide_second_difference(middle, kStep), second, 1e-11);
}

TEST(WideDifferences, KeepAnAccelerationUpToAFifthOfTheRate) {
  constexpr double kStep = 0.005;
  const double w = 2 * std::numbers::pi * 0.2 / kStep;
  std::array<double, 2 * kDifferenceReach + 1> values{};
  for (Eigen::Index i = -kDifferenceReach; i <= kDifferenceReach; ++i) {
    values[static_cast<std::size_t>(i + kDifferenceReach)] =
        std::cos(w * kStep * static_cast<double>(i) - 1);
  }
  const double* const middle = values.data() + kDifferenceReach;
  EXPECT_NEAR(wide_first_difference(middle, kStep) / (w * std::sin(1)), 1, 0.003);
  EXPECT_NEAR(wide_second_difference(middle, kStep) / (-w * w * std::cos(1)), 1, 0.001);
}

}  // namespace
}  // namespace dyngen::runtime
