// SPDX-License-Identifier: MIT
#include "runtime/recordings/trajectory_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "runtime/recordings/spline.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Two joints: sin(3 t), 0.5 cos(2 t), every `step` seconds.
Trajectory waves(Index samples, double step) {
  Trajectory trajectory;
  trajectory.time = VectorXd::LinSpaced(samples, 0, step * static_cast<double>(samples - 1));
  trajectory.q.resize(samples, 2);
  trajectory.dq.resize(samples, 2);
  trajectory.ddq.resize(samples, 2);
  const Eigen::ArrayXd t = trajectory.time.array();
  trajectory.q << (3 * t).sin(), 0.5 * (2 * t).cos();
  trajectory.dq << 3 * (3 * t).cos(), -(2 * t).sin();
  trajectory.ddq << -9 * (3 * t).sin(), -2 * (2 * t).cos();
  return trajectory;
}

std::string file_with(const std::string& name, const std::string& text) {
  const std::string path = test::temporary_path(name);
  std::ofstream(path) << text;
  return path;
}

std::string error_of(const std::string& path) {
  try {
    read_trajectory(path);
  } catch (const RecordingError& error) {
    return error.what();
  }
  return "";
}

TEST(TrajectoryFile, ReadsWhatItWrote) {
  const Trajectory written = waves(50, 0.1);
  const std::string path = test::temporary_path("written.csv");
  write_trajectory(written, path);
  std::vector<Notice> repairs;
  const Trajectory read = read_trajectory(path, &repairs);
  EXPECT_TRUE(repairs.empty());
  EXPECT_EQ(read.time, written.time);
  EXPECT_EQ(read.q, written.q);
  EXPECT_EQ(read.dq, written.dq);
  EXPECT_EQ(read.ddq, written.ddq);
  std::ifstream stream(path);
  std::string header;
  std::getline(stream, header);
  EXPECT_EQ(header, "time,q1,q2,qd1,qd2,qdd1,qdd2");
}

TEST(TrajectoryFile, TakesARecordingAndIgnoresItsTorque) {
  const Trajectory read =
      read_trajectory(file_with("recording.csv", "time,q1,tau1\n0,1,50\n0.1,1,60\n0.2,1,70\n"));
  EXPECT_EQ(read.q, MatrixXd::Ones(3, 1));
  EXPECT_EQ(read.dq, MatrixXd::Zero(3, 1));
  EXPECT_EQ(read.ddq, MatrixXd::Zero(3, 1));
}

TEST(TrajectoryFile, TwoRowsAreAConstantReference) {
  const Trajectory read =
      read_trajectory(file_with("step.csv", "time,q1,q2\n0,0.5,-1\n2,0.5,-1\n"));
  EXPECT_EQ(read.samples(), 2);
  VectorXd q(2), dq(2), ddq(2);
  motion_at(read, 1.234, q.data(), dq.data(), ddq.data());
  EXPECT_EQ(q, Eigen::Vector2d(0.5, -1));
  EXPECT_EQ(dq, Eigen::Vector2d::Zero());
  EXPECT_EQ(ddq, Eigen::Vector2d::Zero());
}

TEST(TrajectoryFile, AbsentDerivativesComeFromSplines) {
  // The error of a spline's derivative falls with the third power of the step at the ends.
  double before = 0;
  for (const double step : {0.02, 0.01, 0.005}) {
    const Trajectory exact = waves(1 + std::lround(2 / step), step);
    Trajectory positions = exact;
    positions.dq = differentiate_spline(exact.time, exact.q);
    positions.ddq = differentiate_spline(exact.time, positions.dq);
    const double dq_error = (positions.dq - exact.dq).cwiseAbs().maxCoeff();
    const double ddq_error = (positions.ddq - exact.ddq).cwiseAbs().maxCoeff();
    EXPECT_LT(dq_error, 20 * std::pow(step, 3));
    EXPECT_LT(ddq_error, 100 * std::pow(step, 2));
    if (before > 0) {
      EXPECT_NEAR(before / dq_error, 8, 1.5);
    }
    before = dq_error;
    const Index inner = exact.samples() - 20;
    EXPECT_LT((positions.ddq - exact.ddq).middleRows(10, inner).cwiseAbs().maxCoeff(),
              300 * std::pow(step, 4));
  }
}

TEST(TrajectoryFile, MissingVelocitiesAreFilledIn) {
  const Trajectory exact = waves(201, 0.01);
  std::string text = "time,q1,q2\n";
  for (Index k = 0; k < exact.samples(); ++k) {
    text += std::to_string(exact.time[k]) + "," + std::to_string(exact.q(k, 0)) + "," +
            std::to_string(exact.q(k, 1)) + "\n";
  }
  const Trajectory read = read_trajectory(file_with("positions.csv", text));
  // std::to_string has six decimals: 5e-7 over a step of 0.01 s
  EXPECT_LT((read.dq - exact.dq).cwiseAbs().maxCoeff(), 5e-4);
}

TEST(TrajectoryFile, SaysWhatIsWrong) {
  EXPECT_NE(error_of(file_with("empty.csv", "")).find("found an empty file"), std::string::npos);
  EXPECT_NE(
      error_of(file_with("word.csv", "time,q1\n0,1\n0.1,one\n0.2,1\n")).find(".csv:3:5: error"),
      std::string::npos);
  std::string gap = "time,q1\n";
  for (int k = 0; k < 20; ++k) gap += std::to_string(k < 10 ? 0.1 * k : 0.1 * k + 5) + ",1\n";
  EXPECT_NE(error_of(file_with("gap.csv", gap)).find("found 2 runs"), std::string::npos);
  EXPECT_NE(error_of(file_with("no_q.csv", "time,tau1\n0,1\n1,1\n"))
                .find("expected a header such as 'time,q1,q2'"),
            std::string::npos);
}

TEST(TrajectoryFile, ValidateRefusesWhatIsNoTrajectory) {
  EXPECT_NO_THROW(waves(5, 0.1).validate());
  Trajectory trajectory = waves(5, 0.1);
  trajectory.dq.resize(4, 2);
  EXPECT_THROW(trajectory.validate(), std::invalid_argument);
  trajectory = waves(5, 0.1);
  trajectory.time[2] = trajectory.time[1];
  EXPECT_THROW(trajectory.validate(), std::invalid_argument);
  trajectory = waves(5, 0.1);
  trajectory.q(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(trajectory.validate(), std::invalid_argument);
  EXPECT_THROW(write_trajectory(trajectory, test::temporary_path("never.csv")),
               std::invalid_argument);
}

TEST(MotionAt, MeetsTheSamplesAndIsAccurateBetween) {
  const double step = 0.01;
  const Trajectory trajectory = waves(101, step);
  VectorXd q(2), dq(2), ddq(2);
  for (Index k = 0; k < trajectory.samples(); ++k) {
    motion_at(trajectory, trajectory.time[k], q.data(), dq.data(), ddq.data());
    EXPECT_TRUE(q.isApprox(trajectory.q.row(k).transpose(), 1e-13));
    EXPECT_TRUE(dq.isApprox(trajectory.dq.row(k).transpose(), 1e-11));
    EXPECT_TRUE(ddq.isApprox(trajectory.ddq.row(k).transpose(), 1e-9));
  }
  // Error of quintic Hermite interpolation: h^6 q^(6) / (64 * 720) at most.
  for (int k = 0; k < 500; ++k) {
    const double t = 0.999 * k / 500;
    motion_at(trajectory, t, q.data(), dq.data(), ddq.data());
    EXPECT_NEAR(q[0], std::sin(3 * t), 2e-14);
    EXPECT_NEAR(dq[0], 3 * std::cos(3 * t), 1e-11);
    EXPECT_NEAR(ddq[0], -9 * std::sin(3 * t), 1e-8);
  }
}

TEST(MotionAt, StandsOutsideTheTrajectory) {
  const Trajectory trajectory = waves(11, 0.1);
  VectorXd q(2), dq(2), ddq(2);
  motion_at(trajectory, -1, q.data(), dq.data(), ddq.data());
  EXPECT_EQ(q, trajectory.q.row(0).transpose());
  EXPECT_EQ(dq, VectorXd::Zero(2));
  motion_at(trajectory, 9, q.data(), nullptr, ddq.data());
  EXPECT_EQ(q, trajectory.q.row(10).transpose());
  EXPECT_EQ(ddq, VectorXd::Zero(2));
  motion_at(trajectory, trajectory.time[10], nullptr, dq.data(), nullptr);
  EXPECT_TRUE(dq.isApprox(trajectory.dq.row(10).transpose(), 1e-11));
}

}  // namespace
}  // namespace dyngen::runtime
