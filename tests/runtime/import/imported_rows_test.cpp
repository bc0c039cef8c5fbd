// SPDX-License-Identifier: MIT
#include "runtime/import/imported_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "tests/runtime/import/fake_log.h"

namespace dyngen::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::HasSubstr;

/// Columns t (s), two positions, two torques, at 1 kHz.
MatrixXd plain_motion(Eigen::Index rows) {
  MatrixXd values(rows, 5);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const double t = 1e-3 * static_cast<double>(k);
    values.row(k) << t, std::sin(t), std::cos(2 * t), 3 * t, 4 - t;
  }
  return values;
}

const std::vector<std::string> kNames = {"t", "q1", "q2", "m1", "m2"};

TEST(ImportedRows, BringsUnitsSignsAndOffsetsToTheJoints) {
  const Imported found = imported(
      "time: {column: t, unit: ms}\n"
      "position: {columns: \"q{n}\", unit: deg, sign: [1, -1], offset: [0, 90 deg]}\n"
      "torque: {columns: \"m{n}\", unit: mN m, gain: 2}\n",
      {table_of("", kNames, plain_motion(100))});
  const MatrixXd raw = plain_motion(100);
  ASSERT_EQ(found.recording.samples(), 100);
  const double deg = std::numbers::pi / 180;
  EXPECT_NEAR(found.recording.time[50], raw(50, 0) / 1000, 1e-15);
  EXPECT_NEAR(found.recording.q(50, 0), raw(50, 1) * deg, 1e-15);
  EXPECT_NEAR(found.recording.q(50, 1), -raw(50, 2) * deg + 90 * deg, 1e-15);
  EXPECT_NEAR(found.recording.tau(50, 1), 2 * raw(50, 4) / 1000, 1e-15);
  EXPECT_EQ(found.recording.lines[50], 52U);
}

TEST(ImportedRows, KeepsPowerAcrossACoupling) {
  const Imported found = imported(
      "time: {column: t, unit: s}\n"
      "position: {columns: \"q{n}\", unit: rad, side: motor}\n"
      "velocity: {columns: \"q{n}\", unit: rad/s, side: motor}\n"
      "torque: {columns: \"m{n}\", unit: N m, side: motor}\n"
      "coupling: [[45, 0], [32, 32]]\n",
      {table_of("", kNames, plain_motion(20))});
  const MatrixXd raw = plain_motion(20);
  Eigen::Matrix2d K;
  K << 45, 0, 32, 32;
  const Eigen::Vector2d q_motor(raw(7, 1), raw(7, 2)), m(raw(7, 3), raw(7, 4));
  const Eigen::Vector2d q = K.inverse() * q_motor, tau = K.transpose() * m;
  EXPECT_LT((found.recording.q.row(7).transpose() - q).norm(), 1e-15);
  EXPECT_LT((found.recording.tau.row(7).transpose() - tau).norm(), 1e-12);
  EXPECT_NEAR(found.recording.dq.row(7).dot(found.recording.tau.row(7)), q_motor.dot(m), 1e-12);
}

TEST(ImportedRows, TakesEachJointFromItsOwnSide) {
  const Imported found = imported(
      "time: {column: t, unit: s}\n"
      "position: {columns: \"q{n}\", unit: rad, side: [joint, motor]}\n"
      "torque: {columns: \"m{n}\", unit: \"%\", rated: [10, 20 N m], side: motor, efficiency: "
      "0.8}\n"
      "gears: [10, -100]\n",
      {table_of("", kNames, plain_motion(20))});
  const MatrixXd raw = plain_motion(20);
  EXPECT_NEAR(found.recording.q(9, 0), raw(9, 1), 1e-15);
  EXPECT_NEAR(found.recording.q(9, 1), raw(9, 2) / -100, 1e-15);
  EXPECT_NEAR(found.recording.tau(9, 0), raw(9, 3) / 100 * 10 * 10 * 0.8, 1e-12);
  EXPECT_NEAR(found.recording.tau(9, 1), raw(9, 4) / 100 * 20 * -100 * 0.8, 1e-12);
}

TEST(ImportedRows, MakesTorqueOfCountsCurrentsAndDuty) {
  const Imported current = imported(
      "time: {rate: 500}\n"
      "position: {columns: \"q{n}\", unit: counts, counts_per_rev: 4096}\n"
      "torque: {columns: \"m{n}\", unit: mA, constant: [0.5, 20 mN m/A], gain: 3}\n",
      {table_of("", kNames, plain_motion(20))});
  const MatrixXd raw = plain_motion(20);
  EXPECT_NEAR(current.recording.time[10], 0.02, 1e-15);
  EXPECT_NEAR(current.recording.q(9, 1), raw(9, 2) / 4096 * 2 * std::numbers::pi, 1e-15);
  EXPECT_NEAR(current.recording.tau(9, 0), raw(9, 3) / 1000 * 0.5 * 3, 1e-15);
  EXPECT_NEAR(current.recording.tau(9, 1), raw(9, 4) / 1000 * 0.02 * 3, 1e-15);

  const Imported duty = imported(
      "time: {column: t, unit: s}\n"
      "position: {columns: q1, unit: rad}\n"
      "velocity: {columns: q2, unit: rad/s}\n"
      "torque: {duty: m1, full: 885, voltage: m2, resistance: 3.4, constant: 0.463}\n",
      {table_of("", kNames, plain_motion(20))});
  const double volts = raw(9, 3) / 885 * raw(9, 4);
  EXPECT_NEAR(duty.recording.tau(9, 0), 0.463 * (volts - 0.463 * raw(9, 2)) / 3.4, 1e-15);
}

/// Columns t and x of a sine, at another rate and phase.
MatrixXd other_clock(double rate, double start, double seconds) {
  const auto rows = static_cast<Eigen::Index>(seconds * rate);
  MatrixXd values(rows, 2);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const double t = start + static_cast<double>(k) / rate;
    values.row(k) << t, std::sin(2 * t);
  }
  return values;
}

TEST(ImportedRows, JoinsTablesByTime) {
  const Imported found = imported(
      "time: {column: t, unit: s}\n"
      "position: {columns: q1, table: a, unit: rad}\n"
      "torque: {columns: x, table: b, unit: N m}\n",
      {table_of("a", kNames, plain_motion(3000)),
       table_of("b", {"t", "x"}, other_clock(333, 0.5, 2))});
  const auto& recording = found.recording;
  ASSERT_GT(recording.samples(), 1900);
  EXPECT_GE(recording.time[0], 0.5);
  double worst = 0;
  for (Eigen::Index k = 0; k < recording.samples(); ++k) {
    worst = std::max(worst, std::abs(recording.tau(k, 0) - std::sin(2 * recording.time[k])));
  }
  EXPECT_LT(worst, 4 * (1.0 / 333) * (1.0 / 333) / 8 * 1.01);  // of the line: x'' h^2 / 8
  EXPECT_THAT(found.notices, testing::Contains(HasSubstr("'b' has not begun")));
  EXPECT_THAT(found.notices, testing::Contains(HasSubstr("'b' has ended")));
}

/// Of a table whose rows are absent for a while nothing is made, whatever its steps are.
TEST(ImportedRows, MakesNothingOverAGapOfATable) {
  for (const double step : {0.001, 0.004, 0.01}) {
    for (const double gap : {0.1, 0.5, 2.0}) {
      const auto table_with_gap = [&](const std::string& name, bool gaps, double own_step) {
        std::vector<double> times;
        for (double t = 0; t < 6; t += own_step) {
          if (!gaps || t <= 2 || t >= 2 + gap) times.push_back(t);
        }
        MatrixXd values(static_cast<Eigen::Index>(times.size()), 2);
        for (Eigen::Index k = 0; k < values.rows(); ++k) {
          const double t = times[static_cast<std::size_t>(k)];
          values.row(k) << t, std::sin(7 * t);
        }
        return table_of(name, {"t", name == "enc" ? "q1" : "m1"}, values);
      };
      const Imported found = imported(
          "time: {column: t, unit: s}\n"
          "position: {columns: \"q{n}\", unit: rad, table: enc}\n"
          "torque: {columns: \"m{n}\", unit: N m, table: drv}\n",
          {table_with_gap("enc", false, 0.004), table_with_gap("drv", true, step)});
      const runtime::Recording& run = found.recording;
      ASSERT_GT(run.samples(), 500);
      double worst = 0;
      int within = 0;
      for (Eigen::Index k = 0; k < run.samples(); ++k) {
        worst = std::max(worst, std::abs(run.tau(k, 0) - std::sin(7 * run.time[k])));
        within += run.time[k] > 2 + step && run.time[k] < 2 + gap - step;
      }
      EXPECT_EQ(within, 0) << step << " " << gap;
      EXPECT_LT(worst, 50 * step * step) << step << " " << gap;  // of straight lines
    }
  }
}

TEST(ImportedRows, JoinsStampsThatWereCountedFromTheirFirst) {
  FakeTable a = table_of("a", kNames, plain_motion(3000));
  FakeTable b = table_of("b", {"t", "x"}, other_clock(333, 0, 2));
  // both in s since 1970; b began half a second later
  a.origin = runtime::ColumnOrigin{1423155837204875566, 1000000000};
  b.origin = runtime::ColumnOrigin{1423155837704875566, 1000000000};
  const Imported found = imported(
      "time: {column: t, unit: s}\n"
      "position: {columns: q1, table: a, unit: rad}\n"
      "torque: {columns: x, table: b, unit: N m}\n",
      {a, b});
  const auto& recording = found.recording;
  ASSERT_GT(recording.samples(), 1900);
  EXPECT_NEAR(recording.time[0], 0.5, 1e-9);
  EXPECT_NEAR(recording.tau(700, 0), std::sin(2 * (recording.time[700] - 0.5)), 1e-5);
  EXPECT_THAT(found.notices, testing::Contains(HasSubstr("those of a calendar")));
}

TEST(ImportedRows, SharesRowsOfTablesWithoutAClock) {
  const MatrixXd raw = plain_motion(120);
  const Imported found = imported(
      "time: {column: time, unit: s}\n"
      "position: {columns: \"q.{n}\", unit: rad}\n"
      "torque: {columns: \"m.{n}\", unit: N m}\n",
      {table_of("time", {"1"}, raw.leftCols(1)), table_of("q", {"1", "2"}, raw.middleCols(1, 2)),
       table_of("m", {"1", "2"}, raw.rightCols(2))});
  EXPECT_EQ(found.recording.samples(), 120);
  EXPECT_EQ(found.recording.tau(77, 1), raw(77, 4));
  EXPECT_THROW(imported("time: {column: time, unit: s}\n"
                        "position: {columns: \"q.{n}\", unit: rad}\n"
                        "torque: {columns: \"m.{n}\", unit: N m}\n",
                        {table_of("time", {"1"}, raw.leftCols(1)),
                         table_of("q", {"1", "2"}, raw.middleCols(1, 2)),
                         table_of("m", {"1", "2"}, raw.rightCols(2).topRows(100))}),
               runtime::RecordingError);
}

TEST(ImportedRows, TakesADelayOff) {
  const Imported found = imported(
      "time: {column: t, unit: s}\n"
      "position: {columns: q1, unit: rad, delay: 2.5 ms}\n"
      "torque: {columns: m1, unit: N m}\n",
      {table_of("", kNames, plain_motion(1000))});
  const auto& recording = found.recording;
  EXPECT_NEAR(recording.q(500, 0), std::sin(recording.time[500] + 0.0025), 1e-10);
  EXPECT_NEAR(recording.tau(500, 0), 3 * recording.time[500], 1e-12);
}

TEST(ImportedRows, SplitsKeepsAndCuts) {
  MatrixXd values(1000, 7);
  values.leftCols(5) = plain_motion(1000);
  for (Eigen::Index k = 0; k < 1000; ++k) {
    values(k, 5) = k < 400 ? 1 : 2;              // phase
    values(k, 6) = k >= 600 && k < 700 ? 0 : 1;  // on
  }
  const Imported found = imported(
      "time: {column: t, unit: s}\n"
      "position: {columns: q1, unit: rad}\n"
      "torque: {columns: m1, unit: N m}\n"
      "runs: {split: phase, keep: on, skip_first: 100 ms, skip_last: 99.5 ms, cut: [[0.2 s, 0.25 "
      "s]]}\n",
      {table_of("", {"t", "q1", "q2", "m1", "m2", "phase", "on"}, values)});
  const auto& recording = found.recording;
  EXPECT_NEAR(recording.time[0], 0.1, 1e-12);
  EXPECT_NEAR(recording.time[recording.samples() - 1], 0.899, 1e-9);
  ASSERT_EQ(recording.run_starts.size(), 4U);
  EXPECT_NEAR(recording.time[recording.run_starts[1]], 0.251, 1e-12);
  EXPECT_NEAR(recording.time[recording.run_starts[2]], 0.4, 1e-12);
  EXPECT_NEAR(recording.time[recording.run_starts[3]], 0.7, 1e-12);
  EXPECT_THAT(found.notices, testing::Contains(HasSubstr("'on' is not true (100 such in all")));
}

TEST(ImportedRows, SaysWhichColumnIsMissing) {
  const auto fault = [](const std::string& map, const runtime::ImportedRobot& robot = {}) {
    try {
      imported(map, {table_of("", kNames, plain_motion(20))}, robot);
    } catch (const runtime::RecordingError& error) {
      return std::string(error.what());
    }
    return std::string("no fault");
  };
  EXPECT_THAT(fault("time: {column: t, unit: s}\nposition: {columns: \"p{n}\", unit: rad}\n"
                    "torque: {columns: \"m{n}\", unit: N m}\n"),
              HasSubstr("map.yaml:2:21: error: found no column 'p1' in log.csv; did you mean 'q1'? "
                        "it has 't', 'q1'"));
  EXPECT_THAT(fault("time: {column: t}\nposition: {columns: \"q{n}\", unit: rad}\n"
                    "torque: {columns: \"m{n}\", unit: N m}\n"),
              HasSubstr("found no unit of time"));
  EXPECT_THAT(fault("time: {column: t, unit: s}\nposition: {columns: \"q{n}\", unit: rad}\n"
                    "torque: {columns: \"m{n}\", unit: N m}\n",
                    {3, {}}),
              HasSubstr("found no column 'q3'"));
  EXPECT_THAT(fault("time: {column: t, unit: s}\nposition: {columns: \"q{n}\", unit: rad}\n"
                    "torque: {columns: \"m{n}\", unit: A}\n"),
              HasSubstr("expected 'constant' too"));
}

TEST(ImportedRows, RefusesUnitsThatTheJointCannotHave) {
  using runtime::MotionKind;
  const runtime::ImportedRobot robot{2, {}, {MotionKind::kAngle, MotionKind::kLength}};
  const auto fault = [&](const std::string& position, const std::string& torque,
                         const std::string& more = "") {
    try {
      imported("time: {column: t, unit: s}\nposition: {columns: \"q{n}\", unit: " + position +
                   "}\ntorque: {columns: \"m{n}\", unit: " + torque + "}\n" + more,
               {table_of("", kNames, plain_motion(20))}, robot);
    } catch (const runtime::RecordingError& error) {
      return std::string(error.what());
    }
    return std::string("no fault");
  };
  EXPECT_EQ(fault("[rad, mm]", "[N m, N]"), "no fault");
  EXPECT_THAT(fault("[mm, mm]", "[N m, N]"),
              HasSubstr("map.yaml:2:36: error: found unit 'mm' of 'q1', and joint 1 of the robot "
                        "is revolute: expected an angle, such as rad or deg"));
  EXPECT_THAT(fault("deg", "[N m, N]"),
              HasSubstr("map.yaml:2:35: error: found unit 'deg' of 'q2', and joint 2 of the robot "
                        "is prismatic: expected a length"));
  EXPECT_THAT(fault("[rad, mm]", "[N m, N m]"),
              HasSubstr("map.yaml:3:39: error: found unit 'N m' of 'm2'"));
  EXPECT_THAT(fault("[rad, mm], offset: [12 mm, 0]", "[N m, N]"),
              HasSubstr("map.yaml:2:55: error: found unit 'mm' of the offset"));
  // a spindle turns where its joint slides
  EXPECT_EQ(fault("deg, side: [joint, motor]", "N m, side: [joint, motor]", "gears: [1, 400]\n"),
            "no fault");
}

TEST(ImportedRows, ACounterWithItsRateIsATime) {
  MatrixXd values = plain_motion(100);
  for (Eigen::Index k = 0; k < 100; ++k) values(k, 0) = static_cast<double>(5000 + 2 * k);
  const Imported found = imported(
      "time: {column: t, rate: 2 kHz}\n"
      "position: {columns: \"q{n}\", unit: rad}\n"
      "torque: {columns: \"m{n}\", unit: N m}\n",
      {table_of("", kNames, values)});
  ASSERT_EQ(found.recording.samples(), 100);
  EXPECT_NEAR(found.recording.time[99] - found.recording.time[0], 0.099, 1e-12);
}

TEST(ImportedRows, LeavesValuesOutThatAreMissing) {
  MatrixXd values = plain_motion(100);
  values(40, 2) = std::nan("");
  const Imported found = imported(
      "time: {column: t, unit: s}\n"
      "position: {columns: \"q{n}\", unit: rad}\n"
      "torque: {columns: \"m{n}\", unit: N m}\n",
      {table_of("", kNames, values)});
  EXPECT_NEAR(found.recording.q(40, 1), (values(39, 2) + values(41, 2)) / 2, 1e-12);
  EXPECT_THAT(found.notices, testing::Contains(HasSubstr("log.csv:42:1: warning: found nothing in "
                                                         "q2")));
}

}  // namespace
}  // namespace dyngen::test
