// SPDX-License-Identifier: MIT
#include "runtime/import/guess/guessed_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "runtime/import/guess/column_words.h"
#include "runtime/import/guess/name_endings.h"
#include "runtime/import/map_file.h"
#include "tests/runtime/import/fake_log.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using runtime::GuessedMap;
using runtime::GuessRobot;
using runtime::SampledLog;
using testing::HasSubstr;
using testing::Not;

/// Two joints at 500 Hz: time, positions, velocities, torques.
/// @param factors  of time, positions, velocities, torques: units
SampledLog moving_log(const std::vector<std::string>& names, const Eigen::Vector4d& factors) {
  constexpr Index kRows = 4000;
  MatrixXd values(kRows, 7);
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0, 1);
  for (Index k = 0; k < kRows; ++k) {
    const double t = 0.002 * static_cast<double>(k);
    values(k, 0) = t * factors[0];
    for (Index j = 0; j < 2; ++j) {
      const double w = j == 0 ? 3.0 : 4.5;
      values(k, 1 + j) = std::sin(w * t) * factors[1];
      values(k, 3 + j) = (w * std::cos(w * t) + 0.001 * noise(random)) * factors[2];
      values(k, 5 + j) = (10 * std::cos(w * t) + 0.1 * noise(random)) * factors[3];
    }
  }
  SampledLog log;
  log.paths = {"log.csv"};
  log.tables.push_back({0, {"", names, {}}, values});
  return log;
}

TEST(ColumnFamilies, AreFoundByNumbersAndNames) {
  const auto families = runtime::column_families(
      {"Time", "ActPos_1", "ActPos_2", "q0", "q1", "effort[elbow]", "effort[wrist]"},
      {"elbow", "wrist"});
  ASSERT_EQ(families.size(), 4U);
  EXPECT_EQ(families[1].pattern, "ActPos_{n}");
  EXPECT_EQ(families[2].pattern, "q{i}");
  EXPECT_EQ(families[3].pattern, "effort[{joint}]");
  EXPECT_EQ(families[3].columns, (std::vector<std::size_t>{5, 6}));
}

TEST(GuessedMap, SaysUnitsAndReasons) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  const GuessedMap guess =
      runtime::guess_map(moving_log({"Time", "Pos1", "Pos2", "Vel1", "Vel2", "Effort1", "Effort2"},
                                    {1000, 1, kDegrees, 1}),
                         {});
  EXPECT_EQ(guess.questions, 0) << guess.yaml;
  EXPECT_THAT(guess.yaml, HasSubstr("time: {column: \"Time\", unit: ms}"));
  EXPECT_THAT(guess.yaml, HasSubstr("; 500 Hz"));
  EXPECT_THAT(guess.yaml, HasSubstr("position: {columns: \"Pos{n}\", unit: rad}"));
  EXPECT_THAT(guess.yaml, HasSubstr("velocity: {columns: \"Vel{n}\", unit: deg/s}"));
  EXPECT_THAT(guess.yaml, HasSubstr("57.3 times the slope"));
  EXPECT_THAT(guess.yaml, HasSubstr("torque: {columns: \"Effort{n}\", unit: N m}"));
  EXPECT_THAT(guess.yaml, HasSubstr("(confidence"));
  const auto map = runtime::parse_import_map(guess.yaml, "guess.yaml");
  EXPECT_EQ(map.position->columns.names.front(), "Pos{n}");
}

TEST(GuessedMap, UsesTheRobotsLimitsAndWeight) {
  GuessRobot robot;
  robot.joints.joints = 2;
  robot.lowest = Eigen::Vector2d(-1.2, -1.2);
  robot.highest = Eigen::Vector2d(1.2, 1.2);
  robot.gravity_torque = Eigen::Vector2d(8, 2);
  constexpr double kDegrees = 180 / std::numbers::pi;
  const std::vector<std::string> names = {"t", "q1", "q2", "qd1", "qd2", "tau1", "tau2"};
  const GuessedMap degrees =
      runtime::guess_map(moving_log(names, {1, kDegrees, kDegrees, 1000}), robot);
  EXPECT_THAT(degrees.yaml, HasSubstr("within the robot's limits in degrees (confidence 95 %)"));
  EXPECT_THAT(degrees.yaml, HasSubstr("unit: mN m"));
  const GuessedMap odd = runtime::guess_map(moving_log(names, {1, 1, 1, 0.001}), robot);
  EXPECT_EQ(odd.questions, 1) << odd.yaml;
  EXPECT_THAT(odd.yaml, HasSubstr("QUESTION: in which unit are the torques (joint 1 reaches"));
  EXPECT_THROW(runtime::parse_import_map(odd.yaml, "map.yaml"), runtime::ImportError);
}

TEST(GuessedMap, AsksWhatTheLogDoesNotDecide) {
  const GuessedMap current = runtime::guess_map(
      moving_log({"t", "q1", "q2", "qd1", "qd2", "Cur1", "Cur2"}, {1, 1, 1, 1}), {});
  EXPECT_EQ(current.questions, 1) << current.yaml;
  EXPECT_THAT(current.yaml, HasSubstr("constant: \"?\""));
  std::string answered = current.yaml;
  answered.replace(answered.find("constant: \"?\""), 13, "constant: 0.1");
  EXPECT_EQ(runtime::parse_import_map(answered, "map.yaml").torque->constant.front(), 0.1);

  const GuessedMap several = runtime::guess_map(
      moving_log({"t", "q1", "q2", "Torque1", "Torque2", "TorqueCur1", "TorqueCur2"}, {1, 1, 1, 1}),
      {});
  EXPECT_THAT(several.yaml, HasSubstr("which columns are the"));
}

TEST(GuessedMap, LeavesCommandsOut) {
  const GuessedMap guess = runtime::guess_map(
      moving_log({"t", "q1", "q2", "q_cmd1", "q_cmd2", "tau1", "tau2"}, {1, 1, 1, 1}), {});
  EXPECT_THAT(guess.yaml, HasSubstr("position: {columns: \"q{n}\""));
  EXPECT_THAT(guess.yaml, HasSubstr("# not measured, by their names, and left out: 'q_cmd{n}'"));
  EXPECT_THAT(guess.yaml, Not(HasSubstr("velocity:")));
}

TEST(GuessedMap, NamesGearsAndColumnsWithoutNames) {
  const std::vector<std::string> names = {"t", "q1", "q2", "qd1", "qd2", "tau1", "tau2"};
  const GuessedMap gears = runtime::guess_map(moving_log(names, {1, 1, -51, 1}), {});
  EXPECT_THAT(gears.yaml, HasSubstr("velocities are [-51"));
  const GuessedMap bare = runtime::guess_map(
      moving_log({"1", "2", "3", "4", "5", "6", "7"}, {1, 1, 1, 1}), {{2, {}}, {}, {}, {}});
  EXPECT_THAT(bare.yaml, HasSubstr("position: {columns: [\"2\", \"3\"], unit: rad}"));
  EXPECT_THAT(bare.yaml, HasSubstr("velocity: {columns: [\"4\", \"5\"], unit: rad/s}"));
}

TEST(GuessedMap, TakesNamesOfJointsFromBrackets) {
  const GuessedMap guess =
      runtime::guess_map(moving_log({"stamp", "position[elbow_joint]", "position[wrist_1_joint]",
                                     "velocity[elbow_joint]", "velocity[wrist_1_joint]",
                                     "effort[elbow_joint]", "effort[wrist_1_joint]"},
                                    {1, 1, 1, 1}),
                         {});
  EXPECT_THAT(guess.yaml, HasSubstr("joints: [\"elbow_joint\", \"wrist_1_joint\"]"));
  EXPECT_THAT(guess.yaml, HasSubstr("position: {columns: \"position[{joint}]\""));
  EXPECT_EQ(guess.questions, 0) << guess.yaml;
}

TEST(NameEndings, SayUnitsOfTheirRole) {
  using runtime::ColumnRole;
  const auto unit = [](const char* name, std::optional<ColumnRole> role) {
    const auto ending = runtime::unit_ending(name, role);
    return ending ? ending->unit : std::string("none");
  };
  EXPECT_EQ(unit("q{n}_deg", ColumnRole::kPosition), "deg");
  EXPECT_EQ(unit("act_pos_rad[{n}]", ColumnRole::kPosition), "rad");
  EXPECT_EQ(unit("PosDeg{n}", ColumnRole::kPosition), "deg");
  EXPECT_EQ(unit("lift_mm", ColumnRole::kPosition), "mm");
  EXPECT_EQ(unit("qd{n}_degps", ColumnRole::kVelocity), "deg/s");
  EXPECT_EQ(unit("vel_rad_s_{n}", ColumnRole::kVelocity), "rad/s");
  EXPECT_EQ(unit("qd_rpm{n}", ColumnRole::kVelocity), "rpm");
  EXPECT_EQ(unit("acc{n}_rad_s2", ColumnRole::kAcceleration), "rad/s^2");
  EXPECT_EQ(unit("tau{n}_Nm", ColumnRole::kTorque), "N m");
  EXPECT_EQ(unit("tau{n}_nm", ColumnRole::kTorque), "N m");
  EXPECT_EQ(unit("TauNm{n}", ColumnRole::kTorque), "N m");
  EXPECT_EQ(unit("tau{n}_mNm", ColumnRole::kTorque), "mN m");
  EXPECT_EQ(unit("tau{n}_MNm", ColumnRole::kTorque), "none");
  EXPECT_EQ(unit("time_us", ColumnRole::kTime), "us");
  EXPECT_EQ(unit("t_ms", ColumnRole::kTime), "ms");
  EXPECT_EQ(unit("cur{n}_A", ColumnRole::kCurrent), "A");
  EXPECT_EQ(unit("cur{n}_a", ColumnRole::kCurrent), "none");
  EXPECT_EQ(unit("axis_deg_{n}", std::nullopt), "deg");
  EXPECT_EQ(unit("load_percent", std::nullopt), "none");
  EXPECT_EQ(unit("qd_ms", ColumnRole::kVelocity), "none");
  EXPECT_EQ(unit("deg", ColumnRole::kPosition), "none");
}

TEST(GuessedMap, TakesUnitsFromTheEndsOfNames) {
  const GuessedMap guess = runtime::guess_map(
      moving_log({"time_us", "q1_deg", "q2_deg", "qd1_degps", "qd2_degps", "tau1_Nm", "tau2_Nm"},
                 {1e6, 1, 1, 1}),
      {});
  EXPECT_EQ(guess.questions, 0) << guess.yaml;
  EXPECT_THAT(guess.yaml, HasSubstr("time: {column: \"time_us\", unit: us}"));
  // 1 rad of amplitude would be taken for radians
  EXPECT_THAT(guess.yaml, HasSubstr("position: {columns: \"q{n}_deg\", unit: deg}"));
  EXPECT_THAT(guess.yaml, HasSubstr("'_deg' is the end of its name"));
  EXPECT_THAT(guess.yaml, HasSubstr("velocity: {columns: \"qd{n}_degps\", unit: deg/s}"));
  EXPECT_THAT(guess.yaml, HasSubstr("torque: {columns: \"tau{n}_Nm\", unit: N m}"));
  EXPECT_NO_THROW(runtime::parse_import_map(guess.yaml, "map.yaml"));
}

TEST(GuessedMap, TakesACounterForTheTimeWhereThereIsNoOther) {
  SampledLog log = moving_log({"tick", "q1", "q2", "qd1", "qd2", "tau1", "tau2"}, {1, 1, 1, 1});
  for (Index k = 0; k < log.tables[0].values.rows(); ++k) {
    log.tables[0].values(k, 0) = static_cast<double>(700 + 2 * k);
  }
  const GuessedMap guess = runtime::guess_map(log, {});
  EXPECT_THAT(guess.yaml, HasSubstr("# no column is a time. tick is a counter: whole numbers that "
                                    "rise by 2 from row to row"));
  EXPECT_THAT(guess.yaml, HasSubstr("time: {column: \"tick\", rate: \"?\"}"));
  EXPECT_THAT(guess.yaml, HasSubstr("at which rate does tick count"));
  // another time comes first
  log.tables[0].table.columns = {"seq", "q1", "q2", "time", "qd2", "tau1", "tau2"};
  log.tables[0].values.col(3) = 0.001 * log.tables[0].values.col(0);
  EXPECT_THAT(runtime::guess_map(log, {}).yaml, HasSubstr("time: {column: \"time\", unit: s}"));
}

TEST(GuessedMap, OrdersJointsByTheNamesOfAMessage) {
  SampledLog log = moving_log({"time", "field.position0", "field.position1", "field.velocity0",
                               "field.velocity1", "field.effort0", "field.effort1"},
                              {1, 1, 1, 1});
  runtime::SampledTable& table = log.tables[0];
  table.table.columns.insert(table.table.columns.end(), {"field.name0", "field.name1"});
  table.values.conservativeResize(Eigen::NoChange, 9);
  table.values.rightCols(2).setConstant(std::nan(""));
  table.words = std::vector<std::string>(7);
  table.words.insert(table.words.end(), {"joint_2", "joint_1"});
  GuessRobot robot;
  robot.joints = {2, {"joint_1", "joint_2"}, {}};
  const GuessedMap guess = runtime::guess_map(log, robot);
  EXPECT_THAT(guess.yaml, HasSubstr("joints are ordered as in the robot file by the names in "
                                    "field.name{i}: joint_1, joint_2"));
  EXPECT_THAT(guess.yaml, HasSubstr("position: {columns: [\"field.position1\", "
                                    "\"field.position0\"], unit: rad}"));
  EXPECT_THAT(guess.yaml, HasSubstr("[\"field.effort1\", \"field.effort0\"]"));
  const GuessedMap without = runtime::guess_map(log, {});
  EXPECT_THAT(without.yaml, HasSubstr("joints stand as in field.name{i}: joint_2, joint_1"));
  EXPECT_THAT(without.yaml, HasSubstr("position: {columns: \"field.position{i}\""));
}

TEST(GuessedMap, RefusesALogWithoutPositions) {
  EXPECT_THROW(
      runtime::guess_map(moving_log({"t", "x", "y", "z", "u", "v", "w"}, {1, 1, 1, 1}), {}),
      runtime::ImportError);
}

}  // namespace
}  // namespace dyngen::test
