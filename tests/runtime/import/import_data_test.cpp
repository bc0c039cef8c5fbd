// SPDX-License-Identifier: MIT
// Logs of real robots, each beside the file that was made of it by hand.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/identification/standing_joints.h"
#include "runtime/import/imported_rows.h"
#include "runtime/import/map_file.h"
#include "runtime/plausibility/derivative_remarks.h"
#include "runtime/recordings/reader.h"
#include "runtime/recordings/signal_repair.h"
#include "runtime/recordings/time_base.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_path.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using runtime::Recording;

std::string map_of(const std::string& name) {
  return std::string(DYNGEN_MAPS) + "/" + name + ".yaml";
}

/// As the log has it, rows repaired but no signals.
Recording imported_log(const std::string& map_name, const std::string& path, int joints) {
  const auto map =
      std::make_shared<const runtime::ImportMap>(runtime::read_import_map(map_of(map_name)));
  runtime::ReadOptions options;
  options.repair_signals = false;
  return runtime::read_recording(runtime::imported_recording(map, {{path}}, {joints, {}}), options);
}

Recording unrepaired(const std::string& path) {
  runtime::ReadOptions options;
  options.repair_signals = false;
  return runtime::read_recording(path, options);
}

/// The largest difference, as a part of what the digits of the printed one leave open.
double worst(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double digits) {
  double most = 0;
  for (Index j = 0; j < a.cols(); ++j) {
    for (Index k = 0; k < a.rows(); ++k) {
      const double step = std::max(std::abs(b(k, j)), 1e-6) * std::pow(10.0, -digits);
      most = std::max(most, std::abs(a(k, j) - b(k, j)) / step);
    }
  }
  return most;
}

TEST(ImportedData, MapsHaveFewLines) {
  for (const auto& entry : std::filesystem::directory_iterator(DYNGEN_MAPS)) {
    std::ifstream file(entry.path());
    int lines = 0;
    for (std::string line; std::getline(file, line);)
      lines += line.empty() || line[0] == '#' ? 0 : 1;
    EXPECT_LE(lines, 15) << entry.path();
    runtime::read_import_map(entry.path().string());
  }
}

TEST(ImportedData, Tx40ComesBackFromItsMotors) {
  const auto path = shared_data("tx40/tx40.csv");
  if (!path) GTEST_SKIP() << skip_sentence("tx40/tx40.csv");
  const Recording joints = unrepaired(*path);
  Eigen::Matrix<double, 6, 6> K = Eigen::Matrix<double, 6, 6>::Zero();
  K.diagonal() << 32, 32, 45, -48, 45, 32;
  K(5, 4) = 32;
  Eigen::RowVectorXd zero(6);
  const double right = std::acos(-1) / 2;
  zero << 0, -right, right, 0, 0, 0;
  const std::string log = temporary_path("tx40_motors.csv");
  {
    std::ofstream file(log);
    file << "t,qm1,qm2,qm3,qm4,qm5,qm6,taum1,taum2,taum3,taum4,taum5,taum6\n";
    for (Index k = 0; k < 5000; ++k) {
      const Eigen::VectorXd q = K * (joints.q.row(k) - zero).transpose();
      const Eigen::VectorXd tau = K.transpose().fullPivLu().solve(joints.tau.row(k).transpose());
      file << fmt::format("{:.17g},{:.17g},{:.17g}\n", joints.time[k], fmt::join(q, ","),
                          fmt::join(tau, ","));
    }
  }
  const Recording made = imported_log("tx40", log, 6);
  ASSERT_EQ(made.samples(), 5000);
  EXPECT_LT((made.q - joints.q.topRows(5000)).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((made.tau - joints.tau.topRows(5000)).cwiseAbs().maxCoeff(), 1e-12);
  std::filesystem::remove(log);
}

TEST(ImportedData, Kr300IsTheFirstOfItsTrainingFiles) {
  const auto log = shared_data("kr300/raw_A.mat"), csv = shared_data("kr300/train_1.csv.gz");
  if (!log || !csv) GTEST_SKIP() << skip_sentence("kr300/raw_A.mat");
  Recording made;
  try {
    made = imported_log("kr300", *log, 6);
  } catch (const runtime::RecordingError& error) {
    if (std::string(error.what()).find("built without") != std::string::npos)
      GTEST_SKIP() << error.what();
    throw;
  }
  const Recording converted = unrepaired(*csv);
  ASSERT_EQ(made.samples(), converted.samples());
  EXPECT_LT((made.time - converted.time).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT(worst(made.q, converted.q, 9), 6);
  EXPECT_LT(worst(made.tau, converted.tau, 9), 6);
}

TEST(ImportedData, KinovaIsReadAsItWasRecorded) {
  const auto log = shared_data("kinova_raw/joint_2_trapez.csv.gz");
  if (!log) GTEST_SKIP() << skip_sentence("kinova_raw/joint_2_trapez.csv.gz");
  const Recording made = imported_log("kinova", *log, 7);
  ASSERT_GT(made.samples(), 1000);
  EXPECT_EQ(made.time[1], 0.001);
  EXPECT_EQ(made.q(0, 1), -0.523715);
  EXPECT_EQ(made.dq(1, 1), 0.00192081);
  EXPECT_EQ(made.tau(0, 1), 18.9779);
  EXPECT_EQ(made.temperature(0, 6), 38.2653);
}

TEST(ImportedData, Ur10IsReadFromItsBag) {
  const auto log = shared_data("ur10_bag/ur10_exciting_trajectory.db3");
  if (!log) GTEST_SKIP() << skip_sentence("ur10_bag");
  Recording made;
  try {
    made = imported_log("ur10_bag", *log, 6);
  } catch (const runtime::RecordingError& error) {
    if (std::string(error.what()).find("built without") != std::string::npos)
      GTEST_SKIP() << error.what();
    throw;
  }
  EXPECT_EQ(made.samples(), 3441);
  EXPECT_NEAR(made.time[1] - made.time[0], 0.008, 1e-9);
  EXPECT_NEAR(made.q(0, 0), 0.61977826, 1e-8);
  EXPECT_NEAR(made.tau(0, 1), -20.64695, 1e-5);
}

TEST(ImportedData, TorqueOfTheServoIsThatOfItsDutyCycle) {
  const auto log = shared_data("xl330/raw_one.json"),
             other = shared_data("xl330/kp400_sin_sin.csv.gz");
  if (!log || !other) GTEST_SKIP() << skip_sentence("xl330/raw_one.json");
  const Recording made = imported_log("xl330", *log, 1);
  std::ifstream file(*log);
  const auto entries = nlohmann::json::parse(file).at("entries");
  ASSERT_GT(made.samples(), 1000);
  for (const Index k : {Index{0}, Index{7}, Index{500}, Index{1000}}) {
    const auto& entry = entries[static_cast<std::size_t>(k)];
    const auto load = static_cast<std::int16_t>(entry.at("load").get<std::uint16_t>());
    const double volts = load / 885.0 * entry.at("input_volts").get<double>();
    const double tau = 0.463 * (volts - 0.463 * entry.at("speed").get<double>()) / 3.4;
    EXPECT_NEAR(made.tau(k, 0), tau, 1e-12) << k;
    EXPECT_EQ(made.q(k, 0), entry.at("position").get<double>());
  }
  EXPECT_LT(made.tau.cwiseAbs().maxCoeff(), 1);  // the servo's stall torque is 0.52 N m
  // the same numbers make the torque of the converted file: 3 of 885 at 7.3 V
  const Recording converted = unrepaired(*other);
  EXPECT_NEAR(converted.tau(0, 0), 0.463 * (3.0 / 885 * 7.3 - 0.463 * converted.dq(0, 0)) / 3.4,
              1e-10);
}

/// No word of what is right.
void expect_no_remark(const std::string& map, const std::string& name, int joints) {
  const auto log = shared_data(name);
  if (!log) GTEST_SKIP() << skip_sentence(name);
  Recording recording = imported_log(map, *log, joints);
  std::vector<runtime::Notice> notices;
  runtime::repair_signals(recording, notices);
  const runtime::TimeBase base = runtime::examine_time_base(recording);
  if (!base.uniform) recording = runtime::resample(recording, base.sample_time);
  std::string words;
  for (const auto& remark : runtime::derivative_remarks(recording, base.sample_time)) {
    words += remark.text + "\n";
  }
  for (const auto& notice : notices) {
    if (notice.message.find("samples only") != std::string::npos) words += notice.message + "\n";
  }
  EXPECT_EQ(words, "") << name;
}

TEST(ImportedData, NothingIsSaidOfKinovasVelocities) {
  expect_no_remark("kinova", "kinova_raw/joint_2_trapez.csv.gz", 7);
  expect_no_remark("kinova", "kinova_raw/joint_4_trapez.csv.gz", 7);
  expect_no_remark("kinova", "kinova_raw/RunTrajectory1.csv.gz", 7);
}

/// Drives give way by 0.4 % of the speed of the joint that moves.
TEST(ImportedData, OneJointMovesInEachOfKinovasSweeps) {
  std::vector<runtime::MotionSource> sweeps;
  for (const char* name : {"joint_2_trapez", "joint_4_trapez"}) {
    const auto log = shared_data(std::string("kinova_raw/") + name + ".csv.gz");
    if (!log) GTEST_SKIP() << skip_sentence("kinova_raw");
    sweeps.push_back(runtime::motion_of(imported_log("kinova", *log, 7), {}));
  }
  const std::vector<bool> revolute(7, true);
  const auto all_but = [](std::size_t joint) {
    runtime::StandingJoints standing(7, true);
    standing[joint - 1] = false;
    return standing;
  };
  EXPECT_EQ(runtime::standing_joints(sweeps, revolute, sweeps),
            (std::vector<runtime::StandingJoints>{all_but(2), all_but(4)}));
}

/// The servo filters its speed: that alone is said, 21 ms.
TEST(ImportedData, TheLagOfTheServosSpeedIsSaid) {
  const auto log = shared_data("xl330/raw_one.json");
  if (!log) GTEST_SKIP() << skip_sentence("xl330/raw_one.json");
  Recording recording = imported_log("xl330", *log, 1);
  const double step = runtime::examine_time_base(recording).sample_time;
  recording = runtime::resample(recording, step);
  const auto remarks = runtime::derivative_remarks(recording, step);
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_THAT(remarks.front().text,
              testing::ContainsRegex("qd1 lags behind q1 by 2[01][.0-9]* ms"));
}

}  // namespace
}  // namespace dyngen::test
