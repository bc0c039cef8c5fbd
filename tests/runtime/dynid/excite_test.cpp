// SPDX-License-Identifier: MIT
// `dynid excite` as its users call it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "runtime/plots/figure.h"
#include "runtime/recordings/periods.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/excite/excite_limits.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

using test::content;
using test::dynid;
using test::Outcome;
using test::temporary_path;

const std::string kRobot = DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot";
const std::string kShort = " --evaluations 120 --starts 2";

TEST(Excite, APendulumOfOneFirstMomentHasATrajectory) {
  const Outcome excite = dynid("excite " DYNGEN_SOURCE_DIR
                               "/tests/data/cases/pendulum_gradient/pend.robot -o " +
                               temporary_path("p.csv") + kShort);
  ASSERT_EQ(excite.exit_code, 0) << excite.out;
  EXPECT_GT(read_trajectory(temporary_path("p.csv")).samples(), 1000);
}

TEST(Excite, WritesATrajectoryWithinTheFilesLimits) {
  const Outcome excite =
      dynid("excite " + kRobot + " -o " + temporary_path("t.csv") + " --json " +
            temporary_path("t.json") + kShort + " --periods 3 --noise 1,1.5,0.7");
  ASSERT_EQ(excite.exit_code, 0) << excite.out;
  EXPECT_NE(excite.out.find("condition number"), std::string::npos);
  EXPECT_NE(excite.out.find("whole samples a period"), std::string::npos);

  const Trajectory trajectory = read_trajectory(temporary_path("t.csv"));
  EXPECT_EQ(trajectory.samples(), 3 * 2000 + 1);
  EXPECT_LT(trajectory.dq.row(0).norm(), 1e-9);
  EXPECT_LT(trajectory.ddq.row(0).norm(), 1e-9);
  EXPECT_LT((trajectory.q.row(0) - trajectory.q.row(2000)).norm(), 1e-9);
  const DescribedRobot robot =
      describe_robot(kRobot, OpenParameters::kAbsentRows, {.gradient = true});
  const MotionLimits limits = limits_of(robot, {}).limits;
  const LimitShares shares =
      limit_shares(robot.linear, limits, {trajectory.q, trajectory.dq, trajectory.ddq});
  EXPECT_LE(shares.largest(), 1);
  EXPECT_GT(shares.position.maxCoeff(), 0.5);

  const auto json = nlohmann::json::parse(content(temporary_path("t.json")));
  EXPECT_EQ(json["schema"], "dynid.excitation/1");
  EXPECT_TRUE(json["found"]);
  EXPECT_LT(json["condition"]["optimised"], json["condition"]["random"]);
  EXPECT_EQ(json["trajectory"]["samples_per_period"], 2000);
  EXPECT_EQ(json["parameters"].size(), static_cast<std::size_t>(robot.linear.size()));
  for (const char* kind : {"position", "acceleration"}) {
    for (const auto& share : json["largest_share_of_limits"][kind]) EXPECT_LE(share, 1.0);
  }
}

TEST(Excite, GivesTheSameBytesForTheSameSeed) {
  const std::string command = "excite " + kRobot + kShort + " --periods 1 --seed 5 -o ";
  ASSERT_EQ(dynid(command + temporary_path("a.csv")).exit_code, 0);
  ASSERT_EQ(dynid(command + temporary_path("b.csv")).exit_code, 0);
  EXPECT_EQ(content(temporary_path("a.csv")), content(temporary_path("b.csv")));
}

TEST(Excite, PeriodsAreFoundInARecordingOfIt) {
  ASSERT_EQ(dynid("excite " + kRobot + kShort +
                  " --base-frequency 0.13 --rate 100 --periods 4 -o " + temporary_path("t.csv"))
                .exit_code,
            0);
  const Trajectory trajectory = read_trajectory(temporary_path("t.csv"));
  Recording recording;
  recording.time = trajectory.time;
  recording.q = trajectory.q;
  recording.run_starts = {0};
  recording.tau = MatrixXd::Ones(trajectory.samples(), 3);
  const Periods periods = find_periods(recording);
  EXPECT_EQ(periods.samples, 769) << periods.message;  // 100 Hz / 0.13 Hz, the nearest whole number
  EXPECT_EQ(periods.count, 4);
}

TEST(Excite, EveryFormAndCriterionIsUnderstood) {
  for (const std::string options :
       {"--form spline --criterion a", "--form multistage --rate 100",
        "--criterion d --unit-columns", "--parameters inertial --limits 0.5",
        "--parameters ZZ3,MX2 --acceleration 3"}) {
    const Outcome excite = dynid("excite " + kRobot + " --evaluations 30 --starts 1 " + options +
                                 " -o " + temporary_path("t.csv"));
    EXPECT_EQ(excite.exit_code, 0) << options << "\n" << excite.out;
    const Trajectory trajectory = read_trajectory(temporary_path("t.csv"));
    EXPECT_LT(trajectory.dq.bottomRows(1).norm(), 1e-9) << options;
  }
}

TEST(Excite, EarlierRecordingsAreTakenIntoAccount) {
  const std::string command = "excite " + kRobot + kShort + " --rate 50 --periods 2 -o ";
  ASSERT_EQ(dynid(command + temporary_path("first.csv")).exit_code, 0);
  const Trajectory first = read_trajectory(temporary_path("first.csv"));
  const DescribedRobot robot = describe_robot(kRobot, OpenParameters::kAbsentRows);
  Recording recording;
  recording.time = first.time;
  recording.q = first.q;
  recording.run_starts = {0};
  recording.tau = robot.linear.torque(first.q, first.dq, first.ddq,
                                      Eigen::VectorXd::Constant(robot.linear.size(), 0.5));
  recording.tau += 0.1 * MatrixXd::Random(first.samples(), 3);
  write_recording(recording, temporary_path("rec.csv"));
  ASSERT_EQ(dynid("accumulate " + kRobot + " " + temporary_path("rec.csv") + " --period off -o " +
                  temporary_path("first.qr"))
                .exit_code,
            0);
  const Outcome next = dynid(command + temporary_path("next.csv") + " --criterion a --prior " +
                             temporary_path("first.qr") + " --json " + temporary_path("next.json"));
  ASSERT_EQ(next.exit_code, 0) << next.out;
  const auto json = nlohmann::json::parse(content(temporary_path("next.json")));
  // the recording's noise: uniform of +-0.1, less what the filter takes
  for (const auto& noise : json["noise"]) {
    EXPECT_GT(noise, 0.001);
    EXPECT_LT(noise, 0.1);
  }
  for (const auto& parameter : json["parameters"]) {
    EXPECT_LT(parameter["std"], 0.1) << parameter;
  }
  const Outcome other = dynid("excite " DYNGEN_SOURCE_DIR "/robots/planar2r.robot --prior " +
                              temporary_path("first.qr") + " -o " + temporary_path("x.csv"));
  EXPECT_EQ(other.exit_code, 1) << other.out;
  EXPECT_NE(other.out.find("first.qr"), std::string::npos);
}

TEST(Excite, TheToolStaysOutOfTheBox) {
  const std::string box = " --keep-out 0.3,2,-2,2,-2,2 --tool 0.4,0,0";
  const Outcome excite =
      dynid("excite " + kRobot + kShort + box + " -o " + temporary_path("t.csv"));
  ASSERT_EQ(excite.exit_code, 0) << excite.out;
  const Trajectory trajectory = read_trajectory(temporary_path("t.csv"));
  const DescribedRobot robot = describe_robot(kRobot, OpenParameters::kAbsentRows);
  LimitOptions options;
  options.keep_out = {0.3, 2, -2, 2, -2, 2};
  options.tool = {0.4, 0, 0};
  const KeepOutBox kept = *limits_of(robot, options).limits.box;
  for (Index k = 0; k < trajectory.samples(); k += 7) {
    EXPECT_LE(kept.tool(trajectory.q.row(k)).position.x(), 0.3 + 1e-9);
  }
}

TEST(LinearModelOfAFile, HasTheGradientOfItsRegressor) {
  const DescribedRobot robot = describe_robot(DYNGEN_SOURCE_DIR "/robots/panda.robot",
                                              OpenParameters::kAbsentRows, {.gradient = true});
  const LinearModel& model = robot.linear;
  std::srand(7);
  const Index samples = 70;  // more than a block of the evaluation
  const JointMotion motion{2 * MatrixXd::Random(samples, 7), 2 * MatrixXd::Random(samples, 7),
                           5 * MatrixXd::Random(samples, 7)};
  const MatrixXd A = MatrixXd::Random(samples, Index{7} * model.size());
  const auto s = [&](const JointMotion& at) {
    MatrixXd Y;
    model.regressor(at.q, at.dq, at.ddq, Y);
    return Eigen::VectorXd(A.cwiseProduct(Y).rowwise().sum());
  };
  const JointMotion gradient = model.regressor_gradient(motion, A);
  const double h = 1e-5;
  for (MatrixXd JointMotion::*part : {&JointMotion::q, &JointMotion::dq, &JointMotion::ddq}) {
    for (Index j = 0; j < 7; ++j) {
      JointMotion after = motion, before = motion;
      (after.*part).col(j).array() += h;
      (before.*part).col(j).array() -= h;
      const Eigen::VectorXd difference = (s(after) - s(before)) / (2 * h);
      // truncation h^2 times third derivatives of some hundreds
      EXPECT_LT((difference - (gradient.*part).col(j)).cwiseAbs().maxCoeff(), 1e-6) << j;
    }
  }
  EXPECT_THROW(model.regressor_gradient(motion, A.leftCols(3)), std::invalid_argument);
  EXPECT_FALSE(describe_robot(kRobot, OpenParameters::kAbsentRows).linear.regressor_gradient);
}

TEST(ToolPointOfTheFile, HasTheDerivativesOfItsPosition) {
  const DescribedRobot robot =
      describe_robot(DYNGEN_SOURCE_DIR "/robots/panda.robot", OpenParameters::kAbsentRows);
  LimitOptions options;
  options.keep_out = {0, 1, 0, 1, 0, 1};
  options.tool = {0.1, -0.2, 0.3};
  const KeepOutBox box = *limits_of(robot, options).limits.box;
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(7, -1, 0.8);
  const double h = 1e-6;
  for (Index j = 0; j < 7; ++j) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(7, j);
    const Eigen::Vector3d slope =
        (box.tool(q + step).position - box.tool(q - step).position) / (2 * h);
    EXPECT_LT((slope - box.tool(q).jacobian.col(j)).norm(), 1e-8) << j;
  }
}

TEST(Excite, SaysWhatIsWrong) {
  const std::string out = " -o " + temporary_path("t.csv");
  EXPECT_EQ(dynid("excite " + kRobot).exit_code, 2);
  EXPECT_EQ(dynid("excite " + kRobot + out + " --form polynomial").exit_code, 2);
  EXPECT_EQ(dynid("excite " + kRobot + out + " --form multistage --criterion d").exit_code, 2);
  EXPECT_EQ(dynid("excite " + kRobot + out + " --keep-out 1,2").exit_code, 2);
  EXPECT_EQ(dynid("excite " + kRobot + out + " --duration 5 --base-frequency 1").exit_code, 2);
  const Outcome unknown = dynid("excite " + kRobot + out + " --parameters ZZ9");
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_NE(unknown.out.find("ZZ9"), std::string::npos);
  EXPECT_EQ(dynid("excite " + kRobot + out + " --noise 1,2").exit_code, 1);
  EXPECT_EQ(dynid("excite " + kRobot + out + " --keep-out 2,1,0,1,0,1").exit_code, 1);
  EXPECT_EQ(dynid("excite absent.robot" + out).exit_code, 1);
  // without gnuplot it is refused before its ending is looked at
  EXPECT_EQ(dynid("excite " + kRobot + kShort + out + " --picture picture.bmp").exit_code,
            can_draw() ? 1 : 2);
}

TEST(Excite, CannotAnswerWhereNothingKeepsTheLimits) {
  const std::string file = temporary_path("t3.csv");
  const Outcome excite =
      dynid("excite " + kRobot + kShort + " --keep-out -9,9,-9,9,-9,9 -o " + file);
  EXPECT_EQ(excite.exit_code, 3) << excite.out;
  EXPECT_NE(excite.out.find("no trajectory"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace dyngen::runtime
