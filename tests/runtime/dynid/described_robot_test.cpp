// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/described_robot.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "gen/diagnostic/diagnostic.h"
#include "runtime/tools/dynid/robot/identified_file.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::string robot_path(const std::string& name) { return DYNGEN_SOURCE_DIR "/" + name; }

MatrixXd random_matrix(Index rows, Index columns, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-3, 3);
  return MatrixXd::NullaryExpr(rows, columns, [&]() { return uniform(random); });
}

/// Base parameters from a file's numbers.
VectorXd beta_of(const DescribedRobot& robot) {
  VectorXd beta(robot.linear.size());
  for (int i = 0; i < robot.linear.size(); ++i) {
    beta[i] = robot.linear.parameters[static_cast<std::size_t>(i)].value.value();
  }
  return beta;
}

class DescribedRobots : public testing::TestWithParam<const char*> {};

TEST_P(DescribedRobots, GiveTheTorqueOfTheJudge) {
  const DescribedRobot robot = describe_robot(robot_path(GetParam()), OpenParameters::kAsWritten);
  const int n = robot.linear.joints();
  constexpr Index kSamples = 70;  // more than a block of the evaluation
  const MatrixXd q = random_matrix(kSamples, n, 1), dq = random_matrix(kSamples, n, 2),
                 ddq = random_matrix(kSamples, n, 3);
  const MatrixXd tau = robot.linear.torque(q, dq, ddq, beta_of(robot));
  const test::NumericRobot numeric = test::numeric_robot(robot.model);
  double worst = 0, largest = 0;
  for (Index k = 0; k < kSamples; ++k) {
    test::MotionSample sample;
    for (int j = 0; j < n; ++j) {
      sample.q.push_back(q(k, j));
      sample.dq.push_back(dq(k, j));
      sample.ddq.push_back(ddq(k, j));
    }
    const std::vector<double> wanted = test::judge(robot.model, numeric, "id", sample);
    for (int j = 0; j < n; ++j) {
      worst = std::max(worst, std::abs(tau(k, j) - wanted[static_cast<std::size_t>(j)]));
      largest = std::max(largest, std::abs(wanted[static_cast<std::size_t>(j)]));
    }
  }
  EXPECT_LT(worst, 1e-10 * largest);
}

TEST_P(DescribedRobots, GroupTheFilesOwnParameters) {
  const DescribedRobot robot = describe_robot(robot_path(GetParam()), OpenParameters::kAsWritten);
  const VectorXd grouped = robot.grouping * robot.standard;
  const VectorXd beta = beta_of(robot);
  EXPECT_LT((grouped - beta).norm(), 1e-12 * (1 + beta.norm()));
}

TEST_P(DescribedRobots, ComeBackFromTheirIdentifiedFile) {
  const DescribedRobot robot = describe_robot(robot_path(GetParam()), OpenParameters::kAsWritten);
  const VectorXd beta = beta_of(robot);
  const std::string path = test::temporary_path("identified.robot");
  std::ofstream(path) << identified_text(robot, carried(robot, beta), {{"identified"}});
  const DescribedRobot again = describe_robot(path, OpenParameters::kAsWritten);
  ASSERT_EQ(again.linear.joints(), robot.linear.joints());
  const Index n = robot.linear.joints();
  const MatrixXd q = random_matrix(20, n, 1), dq = random_matrix(20, n, 2),
                 ddq = random_matrix(20, n, 3);
  const MatrixXd before = robot.linear.torque(q, dq, ddq, beta);
  const MatrixXd after = again.linear.torque(q, dq, ddq, beta_of(again));
  // twelve digits of the file
  EXPECT_LT((before - after).cwiseAbs().maxCoeff(), 1e-10 * before.cwiseAbs().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(Files, DescribedRobots,
                         testing::Values("robots/planar2r.robot", "robots/puma560.robot",
                                         "robots/stanford.robot", "robots/scara.robot",
                                         "tests/robots/puma560_corke_std.robot"));

TEST(DescribeRobot, OpensAbsentRowsAndKeepsWrittenZeros) {
  const std::string path = test::temporary_path("open.robot");
  std::ofstream(path) << "number_link 2\nsigma 0 0\nal 0 pi/2\nd 0 0.3\nth 0 0\nr 0 0\n"
                         "mY 0 0\nFs 0 *\ngx 0\ngy 0\ngz 9.81\n";
  const DescribedRobot robot = describe_robot(path, OpenParameters::kAbsentRows);
  std::vector<std::string> names;
  for (const LinearParameter& parameter : robot.linear.parameters) names.push_back(parameter.name);
  const auto has = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  EXPECT_FALSE(has("MY2"));  // written as zero
  EXPECT_FALSE(has("FS1"));
  EXPECT_TRUE(has("FS2"));
  EXPECT_TRUE(has("FV1"));  // rows that are absent
  EXPECT_TRUE(has("OFF2"));
  const DescribedRobot written = describe_robot(path, OpenParameters::kAsWritten);
  EXPECT_EQ(written.linear.size(), 1);  // FS2 alone
}

TEST(DescribeRobot, WantsNumbersForLengths) {
  const std::string path = test::temporary_path("unknown_length.robot");
  std::ofstream(path) << "number_link 2\nsigma 0 0\nal 0 0\nd 0 *\nth 0 0\nr 0 0\n"
                         "gx 0\ngy 0\ngz 9.81\n";
  try {
    describe_robot(path, OpenParameters::kAbsentRows);
    FAIL() << "no error";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("unknown_length.robot:4:5: error: 'd' is unknown"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace dyngen::runtime
