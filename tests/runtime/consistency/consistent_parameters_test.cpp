// SPDX-License-Identifier: MIT
#include "runtime/consistency/consistent_parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <stdexcept>

#include "runtime/consistency/pseudo_inertia.h"
#include "tests/runtime/consistency/measured_robot.h"

namespace dyngen::runtime {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

void expect_consistent(const ConsistentEstimate& estimate) {
  for (Eigen::Index link = 0; link < estimate.smallest_eigenvalue.size(); ++link) {
    SCOPED_TRACE(link);
    EXPECT_GT(smallest_eigenvalue(estimate.chi.segment<10>(14 * link)), 0);
    EXPECT_EQ(smallest_eigenvalue(estimate.chi.segment<10>(14 * link)),
              estimate.smallest_eigenvalue[link]);
    for (int kind = 10; kind < 13; ++kind) EXPECT_GE(estimate.chi[14 * link + kind], 0);
  }
}

/// One link about a horizontal axis z: ZZ, MX, MY, FV, FS and OFF are seen, each with its own
/// standard deviation 0.01.
ConsistencyProblem pendulum(double ZZ, double MX, double MY, double FV, double FS, double OFF) {
  ConsistencyProblem problem;
  problem.links = 1;
  problem.K = Eigen::MatrixXd::Zero(6, 14);
  int row = 0;
  for (const int seen : {5, 6, 7, 11, 12, 13}) problem.K(row++, seen) = 1;
  problem.K(0, 10) = 1;  // ZZ + IA
  problem.R = Eigen::MatrixXd::Identity(6, 6) * 100;
  Eigen::VectorXd beta(6);
  beta << ZZ, MX, MY, FV, FS, OFF;
  problem.z = problem.R * beta;
  problem.prior = Eigen::VectorXd::Constant(14, kUnknown);
  problem.free.assign(14, true);
  problem.free[10] = false;
  return problem;
}

TEST(FitConsistent, WithoutNoiseFindsTheTruth) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const int links : {1, 3, 6}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", links " << links);
      test::MeasuredRobot robot = test::measured_robot(seed, links, 1e-3);
      robot.problem.prior = robot.chi;
      const ConsistentEstimate at_truth = fit_consistent(robot.problem);
      EXPECT_TRUE(at_truth.converged) << at_truth.message;
      EXPECT_LT((at_truth.beta - robot.beta).norm(), 1e-9 * robot.beta.norm());
      EXPECT_LT((at_truth.chi - robot.chi).norm(), 1e-7 * robot.chi.norm());
      EXPECT_EQ(at_truth.message, "");

      robot.problem.prior.setConstant(kUnknown);
      const ConsistentEstimate blind = fit_consistent(robot.problem);
      EXPECT_TRUE(blind.converged) << blind.message;
      EXPECT_LT((blind.beta - robot.beta).norm(), 1e-6 * robot.beta.norm()) << blind.cost;
      expect_consistent(blind);
    }
  }
}

TEST(FitConsistent, WithStrongNoiseIsConsistentAndNearerToTheTruth) {
  double error_free = 0, error = 0;
  int inconsistent = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    test::MeasuredRobot robot = test::measured_robot(seed, 3, 20);
    test::add_noise(robot.problem, 1000 + seed);
    const ConsistentEstimate estimate = fit_consistent(robot.problem);
    EXPECT_TRUE(estimate.converged) << estimate.message;
    expect_consistent(estimate);
    EXPECT_GE(estimate.cost, estimate.cost_free);
    EXPECT_LT((robot.problem.K * estimate.chi - estimate.beta).norm(), 1e-12);
    // The free solution fits to cost 0; above it some base parameters belong to no body.
    inconsistent += estimate.cost > 1;
    error_free += (robot.problem.z - robot.problem.R * robot.beta).norm();
    error += (robot.problem.R * (estimate.beta - robot.beta)).norm();
  }
  std::cout << "free " << error_free / 50 << ", consistent " << error / 50 << " deviations; of 50 "
            << inconsistent << " free solutions are inconsistent\n";
  EXPECT_GE(inconsistent, 45);
  EXPECT_LT(error, error_free);
}

TEST(FitConsistent, FrictionThatDataWantNegativeIsZeroAndFlagged) {
  const ConsistentEstimate estimate = fit_consistent(pendulum(0.5, 1, 0.2, -0.3, 0.4, -0.7));
  EXPECT_TRUE(estimate.converged) << estimate.message;
  expect_consistent(estimate);
  EXPECT_EQ(estimate.chi[11], 0);
  EXPECT_TRUE(estimate.at_bound[11]);
  EXPECT_FALSE(estimate.at_bound[12]);
  EXPECT_NEAR(estimate.chi[12], 0.4, 1e-6);
  EXPECT_NEAR(estimate.chi[13], -0.7, 1e-6);
  EXPECT_NEAR(estimate.pull[3], 30, 1e-3);
  EXPECT_LT(std::abs(estimate.pull[0]), 0.01);
  EXPECT_NE(estimate.message.find("want them negative: FV1."), std::string::npos)
      << estimate.message;
}

TEST(FitConsistent, SeveralBoundsAtOnceInACorrelatedRobotAreOptimal) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    test::MeasuredRobot robot = test::measured_robot(seed, 4, 0.5);
    for (int link = 0; link < 4; ++link) robot.chi[14 * link + (link % 2 == 0 ? 11 : 12)] = -1;
    robot.problem.z = robot.problem.R * (robot.problem.K * robot.chi);
    const ConsistentEstimate estimate = fit_consistent(robot.problem);
    EXPECT_TRUE(estimate.converged) << estimate.message;
    expect_consistent(estimate);
    const Eigen::VectorXd slope = 2 * (robot.problem.R * robot.problem.K).transpose() *
                                  (robot.problem.R * estimate.beta - robot.problem.z);
    int flagged = 0;
    for (int place = 0; place < 56; ++place) {
      if (place % 14 < 10 || place % 14 > 12) continue;
      const double total = slope[place] + 2 * robot.problem.prior_weight * estimate.chi[place];
      if (estimate.chi[place] == 0) {
        EXPECT_GE(total, 0);
        flagged += estimate.at_bound[static_cast<std::size_t>(place)];
      } else {
        EXPECT_NEAR(total, 0, 1e-5) << place;
        EXPECT_FALSE(estimate.at_bound[static_cast<std::size_t>(place)]);
      }
    }
    EXPECT_GE(flagged, 2);
  }
}

TEST(FitConsistent, InconsistentAndMissingPriorsAreReportedAndReplaced) {
  test::MeasuredRobot robot = test::measured_robot(5, 3, 1);
  robot.problem.prior = robot.chi;
  robot.problem.prior[14 + 0] = 100;  // XX2 > YY2 + ZZ2
  robot.problem.prior[28 + 9] = kUnknown;
  robot.problem.prior[11] = -1;
  robot.problem.R.setZero();  // the prior alone
  robot.problem.z.setZero();
  ConsistencyOptions options;
  options.default_mass = 2;
  options.default_radius = 0.5;
  const ConsistentEstimate estimate = fit_consistent(robot.problem, options);
  EXPECT_TRUE(estimate.converged) << estimate.message;
  TenParameters ball = TenParameters::Zero();
  ball[0] = ball[3] = ball[5] = 0.2;
  ball[9] = 2;
  EXPECT_LT((estimate.chi.segment<10>(0) - robot.chi.segment<10>(0)).norm(), 1e-6);
  // the mass and the centre of an impossible body stay
  EXPECT_LT((estimate.chi.segment<4>(20) - robot.problem.prior.segment<4>(20)).norm(), 1e-6);
  EXPECT_LT((estimate.chi.segment<10>(28) - ball).norm(), 1e-6);
  EXPECT_EQ(estimate.pull.norm(), 0);
  EXPECT_EQ(estimate.message,
            "Links 3: not all ten parameters have a prior; a ball of their mass (2 kg where there "
            "is none), radius 0.5 m stands for "
            "it.\n"
            "Links 2: the prior is of no physical body; a ball of their mass (2 kg where there "
            "is none), radius 0.5 m stands for "
            "it.\n"
            "The prior of FV1 is negative; 0 stands for it.\n" +
                std::string("The data determine 0 of ") + std::to_string(robot.problem.R.cols()) +
                " base parameters; the prior decides the rest.\n");
}

TEST(FitConsistent, PullNamesTheImpossibleBaseParameter) {
  const ConsistentEstimate estimate = fit_consistent(pendulum(-0.5, 0, 0, 0.3, 0.4, 0));
  EXPECT_TRUE(estimate.converged) << estimate.message;
  expect_consistent(estimate);
  EXPECT_NEAR(estimate.pull[0], 50, 0.1);
  EXPECT_NEAR(estimate.cost, 2500, 10);
  EXPECT_LT(estimate.pull.tail(5).cwiseAbs().maxCoeff(), 0.1);

  // In an arm.
  for (unsigned seed = 3; seed <= 30; seed += 3) {
    SCOPED_TRACE(seed);
    test::MeasuredRobot robot = test::measured_robot(seed, 3, 0.01);
    int wrong = -1;  // ZZ3 stands alone or with what is positive
    for (int k = 0; k < robot.problem.K.rows(); ++k) {
      if (std::abs(robot.problem.K(k, 28 + 5) - 1) < 1e-9) wrong = k;
    }
    if (wrong < 0 || robot.problem.K.col(28 + 5).norm() > 1.001) continue;
    robot.problem.R.setIdentity();  // all known alike: else a less known one gives way
    robot.problem.R *= 100;
    Eigen::VectorXd beta = robot.beta;
    beta[wrong] = -1;
    robot.problem.z = robot.problem.R * beta;
    const ConsistentEstimate arm = fit_consistent(robot.problem);
    EXPECT_TRUE(arm.converged) << arm.message;
    expect_consistent(arm);
    Eigen::Index largest = 0;
    arm.pull.cwiseAbs().maxCoeff(&largest);
    EXPECT_EQ(largest, wrong) << arm.pull.transpose();
  }
}

TEST(FitConsistent, TruthOnTheEdgeStaysConsistent) {
  // A point mass: no volume, no prior; known to 1e-6.
  ConsistencyProblem problem = pendulum(1, 1, 0, 0, 0, 0);
  problem.K = Eigen::MatrixXd::Identity(14, 14);
  problem.R = Eigen::MatrixXd::Identity(14, 14) * 1e6;
  Eigen::VectorXd chi = Eigen::VectorXd::Zero(14);
  chi[3] = chi[5] = chi[6] = chi[9] = 1;
  problem.z = problem.R * chi;
  problem.free[10] = true;
  const ConsistentEstimate estimate = fit_consistent(problem);
  expect_consistent(estimate);
  EXPECT_LT((estimate.chi - chi).norm(), 1e-5);
  EXPECT_TRUE(estimate.converged) << estimate.message;
}

TEST(FitConsistent, KeepsWhatIsNotFree) {
  test::MeasuredRobot robot = test::measured_robot(7, 2, 1);
  test::add_noise(robot.problem, 7);
  robot.problem.prior = robot.chi;
  robot.problem.prior[14 + 12] = kUnknown;
  for (const std::size_t fixed : {10U, 11U, 14U + 12U, 14U + 13U}) {
    robot.problem.free[fixed] = false;
  }
  const ConsistentEstimate estimate = fit_consistent(robot.problem);
  EXPECT_EQ(estimate.chi[10], robot.chi[10]);
  EXPECT_EQ(estimate.chi[11], robot.chi[11]);
  EXPECT_EQ(estimate.chi[14 + 12], 0);
  EXPECT_EQ(estimate.chi[14 + 13], robot.chi[14 + 13]);
  EXPECT_NE(estimate.chi[12], robot.chi[12]);
  robot.problem.free.assign(28, false);  // no actuator block at all
  expect_consistent(fit_consistent(robot.problem));
}

TEST(FitConsistent, BothSearchesEndAtTheSameParameters) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    test::MeasuredRobot robot = test::measured_robot(seed, 2, 3);
    test::add_noise(robot.problem, seed);
    robot.problem.prior_weight = 0.1;
    const ConsistentEstimate path = fit_consistent(robot.problem);
    ConsistencyOptions options;
    options.search = ConsistencySearch::kLogCholesky;
    options.max_iterations = 5000;
    const ConsistentEstimate ceres = fit_consistent(robot.problem, options);
    EXPECT_TRUE(ceres.converged) << ceres.message;
    expect_consistent(ceres);
    EXPECT_NEAR(ceres.cost, path.cost, 1e-5 * (1 + path.cost));
    EXPECT_LT((ceres.chi - path.chi).norm(), 1e-3 * path.chi.norm());
    EXPECT_EQ(ceres.at_bound, path.at_bound);
  }
}

TEST(FitConsistent, GivesTheSameBitsTwice) {
  test::MeasuredRobot robot = test::measured_robot(9, 3, 5);
  test::add_noise(robot.problem, 9);
  EXPECT_EQ(fit_consistent(robot.problem).chi, fit_consistent(robot.problem).chi);
}

TEST(FitConsistent, EndsOnSevenLinksWhateverTheNoise) {
  for (const double sigma : {1e-3, 1.0, 30.0}) {
    test::MeasuredRobot robot = test::measured_robot(6, 7, sigma);
    test::add_noise(robot.problem, 6);
    const ConsistentEstimate estimate = fit_consistent(robot.problem);
    EXPECT_TRUE(estimate.converged) << estimate.message;
    expect_consistent(estimate);
  }
}

TEST(FitConsistent, RefusesWrongSizesAndOptions) {
  const ConsistencyProblem good = pendulum(1, 0, 0, 0, 0, 0);
  ConsistencyProblem bad = good;
  bad.links = 2;
  EXPECT_THROW(fit_consistent(bad), std::invalid_argument);
  bad = good;
  bad.R.resize(6, 5);
  EXPECT_THROW(fit_consistent(bad), std::invalid_argument);
  bad = good;
  bad.z.resize(5);
  EXPECT_THROW(fit_consistent(bad), std::invalid_argument);
  bad = good;
  bad.z[0] = kUnknown;
  EXPECT_THROW(fit_consistent(bad), std::invalid_argument);
  bad = good;
  bad.prior.resize(13);
  EXPECT_THROW(fit_consistent(bad), std::invalid_argument);
  bad = good;
  bad.free.clear();
  EXPECT_THROW(fit_consistent(bad), std::invalid_argument);
  bad = good;
  bad.prior_weight = 0;
  EXPECT_THROW(fit_consistent(bad), std::invalid_argument);
  ConsistencyOptions options;
  options.default_mass = -1;
  EXPECT_THROW(fit_consistent(good, options), std::invalid_argument);
  options = {};
  options.floor = 1;
  EXPECT_THROW(fit_consistent(good, options), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
