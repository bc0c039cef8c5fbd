// SPDX-License-Identifier: MIT
#include "runtime/estimation/robust_regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "runtime/estimation/distributions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Line {
  MatrixXd D;
  VectorXd w;
};

/// w = 1 + 2 x + noise with a memory, and x with one too.
Line made_line(Index samples, double memory, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  Line line{MatrixXd::Ones(samples, 2), VectorXd(samples)};
  double x = 0, e = 0;
  for (Index k = 0; k < samples; ++k) {
    x = 0.9 * x + normal(random);
    e = memory * e + normal(random);
    line.D(k, 1) = x;
    line.w[k] = 1 + 2 * x + e;
  }
  return line;
}

TEST(RobustRegression, ExactEquationsGiveTheirNumbers) {
  Line line = made_line(100, 0, 1);
  line.w = line.D * Eigen::Vector2d(3, -4);
  const RobustRegression fit = robust_regression(line.D, line.w, 8);
  EXPECT_NEAR(fit.beta[0], 3, 1e-12);
  EXPECT_NEAR(fit.beta[1], -4, 1e-12);
}

TEST(RobustRegression, CorrelatedNoiseKeepsTheCoverage) {
  const int cosines = cosines_for(400);
  const double t = student_interval(0.95, cosines);
  int held = 0, textbook = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    const Line line = made_line(400, 0.8, seed);
    const RobustRegression fit = robust_regression(line.D, line.w, cosines);
    const double off = std::abs(fit.beta[1] - 2);
    held += off <= t * fit.deviation(1);
    const double white = std::sqrt(fit.inverse(1, 1) * fit.residual.squaredNorm() / 398);
    textbook += off <= 1.96 * white;
  }
  std::cout << "of 400, seeds 0 to 399: " << held << " intervals hold the truth, " << textbook
            << " of the textbook's\n";
  EXPECT_GE(held, 364);  // 0.95 of 400: less once in 1000, and 0.5 % for the short series
  EXPECT_LT(textbook, 320);
}

TEST(RobustRegression, JointTestsOfNothingAreRarelySmall) {
  int small = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    Line line = made_line(400, 0.8, seed);
    line.w -= line.D * Eigen::Vector2d(1, 2);
    small += robust_regression(line.D, line.w, cosines_for(400)).chance(0, 2) < 0.05;
  }
  EXPECT_LE(small, 36);  // of 400 at 5 %: more once in 1000
}

TEST(RobustRegression, ColumnsThatDependOnOneAnotherShareTheirPart) {
  Line line = made_line(200, 0, 4);
  line.D.conservativeResize(200, 3);
  line.D.col(2) = 2 * line.D.col(1);
  const RobustRegression fit = robust_regression(line.D, line.w, 8);
  EXPECT_TRUE(fit.beta.allFinite());
  EXPECT_NEAR(fit.beta[1] + 2 * fit.beta[2], 2, 0.2);
}

}  // namespace
}  // namespace dyngen::runtime
