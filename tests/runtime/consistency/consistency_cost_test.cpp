// SPDX-License-Identifier: MIT
#include "runtime/consistency/consistency_cost.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "runtime/consistency/consistency_path.h"
#include "runtime/consistency/log_cholesky_fit.h"
#include "runtime/consistency/pseudo_inertia.h"
#include "tests/runtime/consistency/measured_robot.h"

namespace dyngen::runtime {
namespace {

ScaledParameters random_parameters(const ConsistencyCost& cost, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  ScaledParameters parameters = at_prior(cost);
  for (Eigen::Matrix4d& S : parameters.S) {
    LogCholesky theta;
    for (double& value : theta) value = normal(random);
    S = from_log_cholesky(theta);
  }
  for (double& value : parameters.actuators) value = std::abs(normal(random));
  return parameters;
}

ConsistencyCost random_cost(unsigned seed, int links, double sigma) {
  test::MeasuredRobot robot = test::measured_robot(seed, links, sigma);
  test::add_noise(robot.problem, seed);
  return make_cost(robot.problem, complete_prior(robot.problem, {}));
}

double total(const ConsistencyCost& cost, const ScaledParameters& parameters) {
  return data_cost(cost, parameters) + cost.weight * prior_distance(cost, parameters);
}

TEST(ConsistencyCost, IsThatOfChi) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    test::MeasuredRobot robot = test::measured_robot(seed, 3, 0.1);
    robot.problem.prior = robot.chi;
    for (const std::size_t fixed : {10U, 13U, 25U}) robot.problem.free[fixed] = false;
    const ConsistencyCost cost = make_cost(robot.problem, complete_prior(robot.problem, {}));
    const ScaledParameters parameters = random_parameters(cost, seed);
    const Eigen::VectorXd chi = to_chi(cost, parameters);
    const double expected = (robot.problem.R * (robot.problem.K * chi) - robot.problem.z).norm();
    EXPECT_NEAR(std::sqrt(data_cost(cost, parameters)), expected, 1e-10 * expected);
    EXPECT_EQ(chi[10], robot.chi[10]);
    EXPECT_EQ(chi[13], robot.chi[13]);
    EXPECT_LT((to_chi(cost, at_prior(cost)) - robot.chi).norm(), 1e-12);
    EXPECT_LT(prior_distance(cost, at_prior(cost)), 1e-12);
  }
}

TEST(PriorDistance, IsTheSameInEveryFrameAndUnit) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0, 1);
  LogCholesky one, other;
  for (double& value : one) value = normal(random);
  for (double& value : other) value = normal(random);
  const Eigen::Matrix4d J = from_log_cholesky(one), J0 = from_log_cholesky(other);
  Eigen::Isometry3d frame = Eigen::Translation3d(0.3, -1, 2) *
                            Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  Eigen::Matrix4d T = frame.matrix();
  T.topRows(3) *= 1000;  // mm
  const auto distance = [](const Eigen::Matrix4d& body, const Eigen::Matrix4d& from) {
    ConsistencyCost cost;
    const Eigen::Matrix4d U = upper_factor(from), inverse = U.inverse();
    return prior_distance(cost, {{inverse * body * inverse.transpose()}, {}});
  };
  const double here = distance(J, J0);
  EXPECT_GT(here, 0.1);
  EXPECT_NEAR(distance(T * J * T.transpose(), T * J0 * T.transpose()), here, 1e-9 * here);
}

TEST(Path, EndsWhereCeresFindsNothingLess) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const double sigma : {1e-4, 0.1, 30.0}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", noise " << sigma);
      const ConsistencyCost cost = random_cost(seed, 3, sigma);
      const NewtonResult path = follow_path(cost);
      EXPECT_TRUE(path.converged) << path.iterations;
      const LogCholeskyFit fit = fit_log_cholesky(cost, {}, path.parameters);
      EXPECT_TRUE(fit.converged) << fit.message;
      const double before = total(cost, path.parameters), after = total(cost, fit.parameters);
      EXPECT_NEAR(after, before, 1e-7 * before + 1e-9);
    }
  }
}

TEST(Path, AndCeresFromThePriorFindTheSameMinimum) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    const ConsistencyCost cost = random_cost(seed, 2, 30);
    const NewtonResult path = follow_path(cost);
    ConsistencyOptions options;
    options.max_iterations = 5000;
    const LogCholeskyFit fit = fit_log_cholesky(cost, options, at_prior(cost));
    const double one = total(cost, path.parameters), other = total(cost, fit.parameters);
    EXPECT_NEAR(other, one, 1e-4 * one) << fit.iterations << " " << fit.message;
  }
}

}  // namespace
}  // namespace dyngen::runtime
