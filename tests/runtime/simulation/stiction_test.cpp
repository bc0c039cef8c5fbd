// SPDX-License-Identifier: MIT
#include "runtime/simulation/stiction.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Mask = Eigen::Array<bool, Eigen::Dynamic, 1>;

constexpr unsigned kSeed = 20261121;

struct Problem {
  MatrixXd M;
  VectorXd torque, coulomb;
  Mask at_rest;
};

Problem random_problem(std::mt19937_64& random, Index n) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.1, 1);
  const MatrixXd A = MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
  Problem problem{A * A.transpose() + 0.01 * MatrixXd::Identity(n, n), VectorXd(n), VectorXd(n),
                  Mask(n)};
  for (Index j = 0; j < n; ++j) {
    problem.torque[j] = 2 * normal(random);
    problem.coulomb[j] = 2 * uniform(random);
    problem.at_rest[j] = uniform(random) > 0.3;
  }
  return problem;
}

/// Accelerations if joint j has the direction of the j-th digit of `code` (0 stays, 1, 2 slide),
/// and whether that is consistent.
bool consistent(const Problem& problem, int code, VectorXd& ddq) {
  const Index n = problem.torque.size();
  MatrixXd A = problem.M;
  VectorXd b = problem.torque;
  Eigen::VectorXi direction = Eigen::VectorXi::Zero(n);
  for (Index j = 0; j < n; ++j, code /= 3) {
    if (!problem.at_rest[j]) {
      if (code % 3 != 0) return false;
      continue;
    }
    direction[j] = code % 3 == 2 ? -1 : code % 3;
    if (direction[j] == 0) {
      A.row(j).setZero();
      A(j, j) = 1;
      b[j] = 0;
    } else {
      b[j] -= direction[j] * problem.coulomb[j];
    }
  }
  ddq = A.fullPivLu().solve(b);
  const VectorXd held = problem.torque - problem.M * ddq;
  for (Index j = 0; j < n; ++j) {
    if (!problem.at_rest[j]) continue;
    if (direction[j] == 0 ? std::abs(held[j]) > problem.coulomb[j] : direction[j] * ddq[j] < 0)
      return false;
  }
  return true;
}

TEST(RestingJoints, AreTheOnlyConsistentOnesOfAllThatThereAre) {
  std::mt19937_64 random(kSeed);
  int stay = 0, slide = 0;
  for (int k = 0; k < 400; ++k) {
    const Index n = 1 + k % 6;
    const Problem problem = random_problem(random, n);
    const RestingJoints found =
        resting_joints(problem.M, problem.torque, problem.coulomb, problem.at_rest);
    int solutions = 0;
    const int codes = static_cast<int>(std::lround(std::pow(3, n)));
    for (int code = 0; code < codes; ++code) {
      VectorXd ddq;
      if (!consistent(problem, code, ddq)) continue;
      ++solutions;
      EXPECT_LT((found.ddq - ddq).norm(), 1e-6 * (1 + ddq.norm())) << "case " << k;
    }
    EXPECT_EQ(solutions, 1) << "case " << k;
    for (Index j = 0; j < n; ++j) {
      if (!problem.at_rest[j]) continue;
      ++(found.direction[j] == 0 ? stay : slide);
      EXPECT_EQ(found.direction[j] == 0, found.ddq[j] == 0);
    }
  }
  EXPECT_GT(stay, 100);
  EXPECT_GT(slide, 100);
}

TEST(RestingJoints, ManyJointsComeToAnEnd) {
  std::mt19937_64 random(kSeed + 1);
  for (int k = 0; k < 50; ++k) {
    const Problem problem = random_problem(random, 30);
    const RestingJoints found =
        resting_joints(problem.M, problem.torque, problem.coulomb, problem.at_rest);
    for (Index j = 0; j < 30; ++j) {
      if (!problem.at_rest[j]) continue;
      if (found.direction[j] == 0) {
        EXPECT_LE(std::abs(found.held[j]), problem.coulomb[j] * (1 + kStictionMargin));
      } else {
        EXPECT_GE(found.ddq[j] * found.direction[j], 0);
        EXPECT_NEAR(found.held[j], found.direction[j] * problem.coulomb[j], 1e-6);
      }
    }
  }
}

TEST(RestingJoints, AJointHeldExactlyStays) {
  const MatrixXd M = MatrixXd::Identity(1, 1);
  const VectorXd coulomb = VectorXd::Constant(1, 3);
  Mask at_rest(1);
  at_rest << true;
  EXPECT_EQ(resting_joints(M, VectorXd::Constant(1, 3), coulomb, at_rest).direction[0], 0);
  EXPECT_EQ(resting_joints(M, VectorXd::Constant(1, -3), coulomb, at_rest).direction[0], 0);
  EXPECT_EQ(resting_joints(M, VectorXd::Constant(1, 3.1), coulomb, at_rest).direction[0], 1);
  EXPECT_EQ(resting_joints(M, VectorXd::Constant(1, -3.1), coulomb, at_rest).direction[0], -1);
}

TEST(RestingJoints, RefusesAnImpossibleMassMatrix) {
  Mask at_rest(1);
  at_rest << true;
  EXPECT_THROW(resting_joints(-MatrixXd::Identity(1, 1), VectorXd::Constant(1, 5),
                              VectorXd::Ones(1), at_rest),
               std::runtime_error);
}

}  // namespace
}  // namespace dyngen::runtime
