// SPDX-License-Identifier: MIT
#include "runtime/consistency/realised_bodies.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>

#include "runtime/consistency/pseudo_inertia.h"
#include "tests/runtime/consistency/measured_robot.h"

namespace dyngen::runtime {
namespace {

/// The ten of each link, without what its actuator adds.
Eigen::VectorXd inertial_part(const Eigen::VectorXd& chi) {
  const Eigen::Index links = chi.size() / 14;
  Eigen::VectorXd ten(10 * links);
  for (Eigen::Index link = 0; link < links; ++link) {
    ten.segment<10>(10 * link) = chi.segment<10>(14 * link);
  }
  return ten;
}

/// A robot whose bodies are known, and a prior that is off by some tens of percent.
RealisationProblem realisation(unsigned seed, int links, double off) {
  const test::MeasuredRobot robot = test::measured_robot(seed, links, 0.1);
  RealisationProblem problem;
  problem.bodies = links;
  problem.K.resize(robot.problem.K.rows(), 10 * links);
  for (int link = 0; link < links; ++link) {
    problem.K.middleCols<10>(10 * link) = robot.problem.K.middleCols<10>(14 * link);
  }
  const Eigen::VectorXd truth = inertial_part(robot.chi);
  problem.beta = problem.K * truth;
  problem.prior = truth;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, off);
  for (int link = 0; link < links; ++link) {
    LogCholesky theta = log_cholesky(pseudo_inertia(truth.segment<10>(10 * link)));
    for (double& value : theta) value += normal(random);
    problem.prior.segment<10>(10 * link) = ten_parameters(from_log_cholesky(theta));
  }
  return problem;
}

double distance(const Eigen::VectorXd& ten, const Eigen::VectorXd& prior) {
  double sum = 0;
  for (Eigen::Index body = 0; body < ten.size() / 10; ++body) {
    const Eigen::Matrix4d J = pseudo_inertia(ten.segment<10>(10 * body));
    const Eigen::Matrix4d ratio = pseudo_inertia(prior.segment<10>(10 * body)).inverse() * J;
    sum += ratio.trace() - std::log(ratio.determinant()) - 4;
  }
  return sum;
}

TEST(RealisedBodies, ExistAndHaveTheBaseParameters) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const RealisationProblem problem = realisation(seed, 2 + static_cast<int>(seed % 5), 0.3);
    const RealisedBodies found = realise_bodies(problem);
    ASSERT_TRUE(found.exact) << found.residual;
    EXPECT_LT((problem.K * found.ten - problem.beta).norm(), 1e-11 * problem.beta.norm());
    for (int body = 0; body < problem.bodies; ++body) {
      EXPECT_TRUE(is_consistent(found.ten.segment<10>(10 * body)));
    }
    // the judge inverts priors of a condition of 1e9
    EXPECT_NEAR(found.prior_distance, distance(found.ten, problem.prior),
                1e-6 * (1 + found.prior_distance));
  }
}

TEST(RealisedBodies, AreTheNearest) {
  const RealisationProblem problem = realisation(7, 4, 0.4);
  const RealisedBodies found = realise_bodies(problem);
  ASSERT_TRUE(found.exact);
  const Eigen::MatrixXd kernel = Eigen::FullPivLU<Eigen::MatrixXd>(problem.K).kernel();
  ASSERT_GT(kernel.cols(), 0);
  for (Eigen::Index k = 0; k < kernel.cols(); ++k) {
    // the search ends within 1e-10 of the least
    const Eigen::VectorXd along = 1e-5 * kernel.col(k).normalized();
    EXPECT_GT(distance(found.ten + along, problem.prior), found.prior_distance - 1e-10);
    EXPECT_GT(distance(found.ten - along, problem.prior), found.prior_distance - 1e-10);
  }
}

TEST(RealisedBodies, AreThePriorWhereItFits) {
  RealisationProblem problem = realisation(3, 3, 0.2);
  problem.beta = problem.K * problem.prior;
  const RealisedBodies found = realise_bodies(problem);
  ASSERT_TRUE(found.exact);
  EXPECT_LT((found.ten - problem.prior).norm(), 1e-9 * problem.prior.norm());
}

TEST(RealisedBodies, OfABarePendulumNeedNoPrior) {
  RealisationProblem problem;
  problem.bodies = 1;
  problem.K = Eigen::MatrixXd::Zero(2, 10);
  problem.K(0, 5) = 1;  // ZZ
  problem.K(1, 6) = 1;  // MX
  problem.beta = Eigen::Vector2d(0.3, 0.5);
  problem.prior = Eigen::VectorXd::Constant(10, std::numeric_limits<double>::quiet_NaN());
  const RealisedBodies found = realise_bodies(problem);
  ASSERT_TRUE(found.exact);
  EXPECT_NEAR(found.ten[5], 0.3, 1e-12);
  EXPECT_NEAR(found.ten[6], 0.5, 1e-12);
  EXPECT_TRUE(is_consistent(found.ten));
  EXPECT_FALSE(found.message.empty());
}

TEST(RealisedBodies, SayWhereNoneExist) {
  RealisationProblem problem = realisation(5, 2, 0.2);
  problem.K = Eigen::MatrixXd::Zero(1, 20);
  problem.K(0, 5) = 1;  // ZZ of a body
  problem.beta = Eigen::VectorXd::Constant(1, -0.1);
  const RealisedBodies found = realise_bodies(problem);
  EXPECT_FALSE(found.exact);
  EXPECT_GT(found.residual, 1e-3);
  for (int body = 0; body < 2; ++body) {
    EXPECT_TRUE(is_consistent(found.ten.segment<10>(10 * body)));
  }
}

}  // namespace
}  // namespace dyngen::runtime
