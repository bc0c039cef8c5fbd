// SPDX-License-Identifier: MIT
// Logs that others have recorded: in the folder of real recordings, and cases of what people have.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "tests/runtime/logs/read_log.h"
#include "tests/runtime/logs/written_logs.h"
#include "tests/support/shared_data.h"

namespace dyngen::test {
namespace {

using Names = std::vector<std::string>;
constexpr std::size_t kAtOnce = 1000;

/// A real log; nothing, and a word, where it is not.
std::unique_ptr<runtime::RawLog> real_log(const std::string& name) {
  const auto path = shared_data(name);
  return path ? runtime::open_log(*path) : nullptr;
}

TEST(RealLog, MatlabOfAKr300IsItsConvertedRecording) {
  if (!absent_package_of("a.mat").empty()) GTEST_SKIP() << "needs libmatio-dev";
  const auto log = real_log("kr300/raw_A.mat");
  if (!log) GTEST_SKIP() << skip_sentence("kr300/raw_A.mat");
  const WholeLog whole = read_whole(*log, kAtOnce);
  const auto rec = std::find_if(whole.tables.begin(), whole.tables.end(),
                                [](const WholeTable& table) { return table.name == "rec"; });
  ASSERT_NE(rec, whole.tables.end());
  const auto path = shared_data("kr300/train_1.csv.gz");
  if (!path) GTEST_SKIP() << skip_sentence("kr300/train_1.csv.gz");
  const auto converted = runtime::open_log(*path);
  const std::vector<double> expected = read_whole(*converted, kAtOnce).tables[0].column("q1");
  const std::vector<double> found = rec->column("act_pos_se_deg[1]");
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    constexpr double kWritten = 1e-7;  // degrees: the converted file has nine digits
    ASSERT_NEAR(found[k], expected[k] * 180 / std::numbers::pi, kWritten);
  }
}

TEST(RealLog, BagOfAUr10HasItsMessages) {
  if (!absent_package_of("a.db3").empty()) GTEST_SKIP() << "needs libsqlite3-dev";
  const auto log = real_log("ur10_bag/ur10_exciting_trajectory.db3");
  if (!log) GTEST_SKIP() << skip_sentence("ur10_bag");
  const WholeLog whole = read_whole(*log, kAtOnce);
  ASSERT_EQ(whole.tables.size(), 1U);
  const WholeTable& table = whole.tables[0];
  EXPECT_EQ(table.name, "/joint_states");
  ASSERT_EQ(table.rows.size(), 3441U);
  ASSERT_EQ(table.columns.size(), 20U);
  EXPECT_EQ((Names{table.columns.begin(), table.columns.begin() + 3}),
            (Names{"received", "stamp", "position[shoulder_pan_joint]"}));
  EXPECT_EQ(table.columns.back(), "effort[wrist_3_joint]");
  // 27.52 s at 125 Hz, from 1 ns on
  EXPECT_EQ(table.column("received").back(), (27520000000 - 1) / 1e9);
  const auto sum = [&](const char* column) {
    const std::vector<double> values = table.column(column);
    return std::accumulate(values.begin(), values.end(), 0.0);
  };
  EXPECT_EQ(table.column("position[shoulder_pan_joint]").front(), 0.6197782590517766);
  EXPECT_EQ(table.column("effort[elbow_joint]").front(), -39.55563608858807);
  EXPECT_TRUE(std::isfinite(sum("velocity[wrist_3_joint]")));
}

TEST(RealLog, JsonOfAnXl330HasItsEntries) {
  const auto path = shared_data("xl330/raw_one.json");
  if (!path) GTEST_SKIP() << skip_sentence("xl330/raw_one.json");
  const auto log = runtime::open_log(*path);
  const WholeLog whole = read_whole(*log, kAtOnce);
  ASSERT_EQ(whole.tables.size(), 1U);
  EXPECT_EQ(whole.tables[0].name, "entries");
  EXPECT_EQ(whole.tables[0].columns, (Names{"position", "speed", "load", "input_volts", "temp",
                                            "timestamp", "goal_position", "torque_enable"}));
  EXPECT_GT(whole.tables[0].rows.size(), 1000U);
  EXPECT_EQ(whole.tables[0].column("timestamp").front(), 0.003500699996948242);
  EXPECT_THAT(whole.notices, testing::HasSubstr("mass = 0.49, length = 0.1, kp = 100, vin = 7.4"));
}

TEST(RealLog, TextOfAKinovaHasItsColumns) {
  for (const char* name : {"RunTrajectory1", "joint_2_trapez", "joint_4_trapez"}) {
    SCOPED_TRACE(name);
    const auto log = real_log(std::string("kinova_raw/") + name + ".csv.gz");
    if (!log) GTEST_SKIP() << skip_sentence("kinova_raw");
    const WholeLog whole = read_whole(*log, kAtOnce);
    ASSERT_EQ(whole.tables.size(), 1U);
    EXPECT_EQ(whole.tables[0].columns.front(), "Time");
    EXPECT_EQ(whole.tables[0].columns[1], "Position1");
    const std::vector<double> time = whole.tables[0].column("Time");
    EXPECT_GT(time.size(), 1000U);
    EXPECT_EQ(time[1] - time[0], 1);
  }
}

struct Case {
  const char* name;
  Names columns, units;
};

TEST(WrittenLog, CasesOfWhatPeopleHaveAreTheSameMotion) {
  const std::vector<Case> all = {
      {"ros_csv",
       {"%time", "field.header.seq", "field.header.stamp", "field.header.frame_id", "field.name0",
        "field.name1", "field.position0", "field.position1", "field.velocity0", "field.velocity1",
        "field.effort0", "field.effort1"},
       {"ns", "", "ns", "", "", "", "", "", "", "", "", ""}},
      {"controller_trace", {"Zeit", "A1", "A2", "M1", "M2"}, {"ms", "°", "°", "Nm", "Nm"}},
      {"units_row", {"time", "q1", "q2", "tau1", "tau2"}, {"s", "rad", "rad", "Nm", "Nm"}},
      {"headerless", {"1", "2", "3", "4", "5"}, {"", "", "", "", ""}},
      {"quoted_decimal_commas", {"time", "q1", "q2", "tau1", "tau2"}, {"", "", "", "", ""}},
  };
  for (const Case& one : all) {
    SCOPED_TRACE(one.name);
    const auto log = runtime::open_log(std::string(DYNGEN_SOURCE_DIR "/tests/data/cases/") +
                                       one.name + "/run.csv.gz");
    const WholeLog whole = read_whole(*log, kAtOnce);
    ASSERT_EQ(whole.tables.size(), 1U);
    EXPECT_EQ(whole.tables[0].columns, one.columns);
    EXPECT_EQ(whole.tables[0].units, one.units);
    ASSERT_EQ(whole.tables[0].rows.size(), 5000U);
    const std::size_t torque = one.columns.size() - 2;
    EXPECT_EQ(whole.tables[0].rows[0][torque], 22.9302168);
    EXPECT_EQ(whole.tables[0].rows[3][torque + 1], 6.15152779);
  }
}

}  // namespace
}  // namespace dyngen::test
