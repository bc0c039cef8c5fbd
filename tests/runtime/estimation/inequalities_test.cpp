// SPDX-License-Identifier: MIT
#include "runtime/estimation/inequalities.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <random>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_matrix(Index rows, Index columns, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

TEST(Inequalities, ANonNegativeSolutionFulfilsItsConditions) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const MatrixXd A = random_matrix(20, 8, seed);
    const VectorXd b = random_matrix(20, 1, seed + 1000);
    const NonNegativeSolution solution = nonnegative_least_squares(A, b);
    ASSERT_TRUE(solution.converged);
    const VectorXd gradient = A.transpose() * (b - A * solution.x);
    for (Index i = 0; i < 8; ++i) {
      EXPECT_GE(solution.x[i], 0);
      EXPECT_LE(gradient[i], 1e-10);
      EXPECT_NEAR(gradient[i] * solution.x[i], 0, 1e-10);
    }
  }
}

TEST(Inequalities, AConstrainedSolutionFulfilsKuhnAndTucker) {
  int held = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const MatrixXd A = random_matrix(30, 6, seed);
    const VectorXd b = random_matrix(30, 1, seed + 2000);
    Inequalities inequalities{random_matrix(5, 6, seed + 3000), VectorXd::Constant(5, 0.05)};
    const ConstrainedSolution solution =
        constrained_least_squares(A, b, inequalities, VectorXd::Zero(6));
    ASSERT_TRUE(solution.feasible);
    const VectorXd slack = inequalities.G * solution.x - inequalities.h;
    EXPECT_GE(slack.minCoeff(), -1e-10);
    EXPECT_GE(solution.multipliers.minCoeff(), 0);
    const VectorXd gradient = A.transpose() * (A * solution.x - b);
    EXPECT_LT((gradient - inequalities.G.transpose() * solution.multipliers).norm(), 1e-9);
    EXPECT_LT(std::abs(slack.dot(solution.multipliers)), 1e-9);
    held += (solution.multipliers.array() > 0).any() ? 1 : 0;
  }
  EXPECT_GT(held, 25);
}

TEST(Inequalities, WithoutOnesThatHoldItIsLeastSquares) {
  const MatrixXd A = random_matrix(30, 6, 7);
  const VectorXd b = random_matrix(30, 1, 8);
  const VectorXd free = A.householderQr().solve(b);
  const Inequalities far{MatrixXd::Identity(6, 6), VectorXd::Constant(6, -100)};
  EXPECT_LT((constrained_least_squares(A, b, far, VectorXd::Zero(6)).x - free).norm(), 1e-12);
  EXPECT_LT((constrained_least_squares(A, b, {}, VectorXd::Zero(6)).x - free).norm(), 1e-12);
}

TEST(Inequalities, WhatIsNotSeenKeepsItsStart) {
  MatrixXd A = random_matrix(30, 4, 9);
  A.col(3) = A.col(2);
  const VectorXd b = A * Eigen::Vector4d(1, 2, 3, 0);
  const VectorXd x = constrained_least_squares(A, b, {}, Eigen::Vector4d(0, 0, 5, -1)).x;
  EXPECT_NEAR(x[2] + x[3], 3, 1e-10);
  EXPECT_NEAR(x[2] - x[3], 6, 1e-10);
}

TEST(Inequalities, ThoseThatContradictEachOtherAreSaid) {
  const MatrixXd A = MatrixXd::Identity(2, 2);
  Inequalities none{MatrixXd(2, 2), Eigen::Vector2d(1, 1)};
  none.G << 1, 0, -1, 0;  // x >= 1 and x <= -1
  EXPECT_FALSE(constrained_least_squares(A, VectorXd::Zero(2), none, VectorXd::Zero(2)).feasible);
}

}  // namespace
}  // namespace dyngen::runtime
