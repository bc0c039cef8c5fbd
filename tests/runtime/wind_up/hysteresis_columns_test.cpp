// SPDX-License-Identifier: MIT
#include "runtime/wind_up/hysteresis_columns.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// There and back with so many samples each way.
VectorXd triangle(Index samples) {
  VectorXd driver(2 * samples);
  driver << VectorXd::LinSpaced(samples, 0, 1), VectorXd::LinSpaced(samples, 1, 0);
  return driver;
}

TEST(HysteresisColumn, DoesNotDependOnTheRate) {
  const VectorXd fast = hysteresis_column(triangle(101), {0}, 0.1);
  const VectorXd slow = hysteresis_column(triangle(1001), {0}, 0.1);
  for (Index k = 0; k < 101; ++k) EXPECT_NEAR(fast[101 + k], slow[1001 + 10 * k], 1e-9);
}

TEST(HysteresisColumn, ReachesBothEndsAndReversesWithinItsReach) {
  const double reach = 0.02;
  const VectorXd z = hysteresis_column(triangle(1001), {0}, reach);
  EXPECT_DOUBLE_EQ(z[500], 1);
  EXPECT_NEAR(z[2001], -1, 1e-12);
  // z = -1 + 2 exp(-x / reach) behind the reversal
  EXPECT_NEAR(z[1001 + 20], -1 + 2 * std::exp(-0.02 / reach), 1e-6);
}

TEST(HysteresisColumn, RunsDoNotKnowOfOneAnother) {
  VectorXd two(404);
  two << triangle(101), -triangle(101);
  const VectorXd both = hysteresis_column(two, {0, 202}, 0.05);
  const VectorXd second = hysteresis_column(-triangle(101), {0}, 0.05);
  EXPECT_EQ(both.tail(202), second);
}

}  // namespace
}  // namespace dyngen::runtime
