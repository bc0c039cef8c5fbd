// SPDX-License-Identifier: MIT
#include "runtime/signals/differences.h"

#include <gtest/gtest.h>

#include <stdexcept>

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

}  // namespace
}  // namespace dyngen::runtime
