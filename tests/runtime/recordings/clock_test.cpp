// SPDX-License-Identifier: MIT
#include "runtime/recordings/clock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

#include "runtime/recordings/held_columns.h"
#include "runtime/recordings/reader.h"
#include "tests/support/temporary_path.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using runtime::Recording;
using testing::HasSubstr;

/// A joint at 500 Hz with stamps that jitter by a part of a step.
/// @param real  samples were taken when their stamps say
Recording jittered(bool real, double jitter, bool velocities) {
  Recording recording;
  recording.file_name = "run.csv";
  recording.run_starts = {0};
  constexpr Index kRows = 4000;
  recording.time.resize(kRows);
  recording.q.resize(kRows, 1);
  recording.tau.resize(kRows, 1);
  if (velocities) recording.dq.resize(kRows, 1);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> late(0, jitter);
  std::normal_distribution<double> noise(0, 1);
  for (Index k = 0; k < kRows; ++k) {
    const double even = 0.002 * static_cast<double>(k);
    recording.time[k] = even + 0.002 * late(random);
    const double t = real ? recording.time[k] : even;
    recording.q(k, 0) = std::sin(5 * t) + 1e-5 * noise(random);
    recording.tau(k, 0) = 3 * std::cos(5 * t) + 0.05 * noise(random);
    if (velocities) recording.dq(k, 0) = 5 * std::cos(5 * t) + 1e-3 * noise(random);
  }
  return recording;
}

TEST(Clock, BelievesStampsThatAreRight) {
  for (const bool velocities : {false, true}) {
    const auto choice = runtime::choose_clock(jittered(true, 0.8, velocities));
    EXPECT_FALSE(choice.rebuilt) << choice.message;
    EXPECT_THAT(choice.message, HasSubstr("the stamps are believed"));
    EXPECT_GT(choice.advantage, 2);
  }
}

TEST(Clock, RebuildsAnEvenClock) {
  for (const bool velocities : {false, true}) {
    const auto choice = runtime::choose_clock(jittered(false, 0.8, velocities));
    EXPECT_TRUE(choice.rebuilt) << choice.message;
    EXPECT_NEAR(choice.step, 0.002, 2e-6);
    EXPECT_THAT(choice.message, HasSubstr("so the clock is rebuilt"));
    const VectorXd steps = choice.time.tail(3999) - choice.time.head(3999);
    EXPECT_LT((steps.array() - choice.step).abs().maxCoeff(), 1e-9);
  }
}

TEST(Clock, LeavesTheGapOfSamplesThatWereLost) {
  Recording whole = jittered(false, 0.8, true), lossy = whole;
  constexpr Index kLost = 3;
  const Index rows = whole.samples() - kLost;
  for (auto* matrix : {&lossy.q, &lossy.dq, &lossy.tau}) {
    const Eigen::MatrixXd all = *matrix;
    *matrix << all.topRows(2000), all.bottomRows(rows - 2000), Eigen::MatrixXd::Zero(kLost, 1);
    matrix->conservativeResize(rows, 1);
  }
  VectorXd time(rows);
  time << whole.time.head(2000), whole.time.tail(rows - 2000);
  lossy.time = time;
  const auto choice = runtime::choose_clock(lossy);
  EXPECT_TRUE(choice.rebuilt) << choice.message;
  EXPECT_NEAR(choice.time[rows - 1] - choice.time[0],
              choice.step * static_cast<double>(whole.samples() - 1), 1e-9);
}

TEST(Clock, SaysThatNoiseTellsNothing) {
  Recording recording = jittered(true, 0.1, false);
  std::mt19937 random(8);
  std::normal_distribution<double> noise(0, 1);
  for (Index k = 0; k < recording.samples(); ++k) {
    recording.q(k, 0) = noise(random);
    recording.tau(k, 0) = noise(random);
  }
  const auto choice = runtime::choose_clock(recording);
  EXPECT_FALSE(choice.rebuilt);
  EXPECT_THAT(choice.message, HasSubstr("neither velocities nor torques tell"));
}

TEST(RepeatedStamps, AreSpreadAndTold) {
  const std::string path = temporary_path("repeated.csv");
  {
    std::ofstream file(path);
    file << "time,q1,tau1\n";
    for (int k = 0; k < 3000; ++k) {  // stamps in whole ms, samples every third of one
      file << (k / 3) * 0.001 << "," << std::sin(0.002 * k) << "," << std::cos(0.002 * k) << "\n";
    }
  }
  std::vector<runtime::Notice> notices;
  const Recording recording = runtime::read_recording(path, {}, &notices);
  ASSERT_EQ(recording.samples(), 3000);
  EXPECT_NEAR(recording.time[1000], 1000 * 0.001 / 3, 1e-9);
  std::string words;
  for (const auto& notice : notices) words += notice.text() + "\n";
  EXPECT_THAT(words, HasSubstr("the rows are spread evenly up to the next time (1000 such in all"));
}

/// Samples at 1 kHz whose clock stands still for some of them.
TEST(RepeatedStamps, OfACoarseClockAreOneRun) {
  for (const int group : {2, 3, 5, 10, 100, 1000}) {
    for (const int first : {0, group / 3}) {  // samples that the first stamp lacks
      SCOPED_TRACE(testing::Message()
                   << group << " rows a stamp, " << first << " before the first");
      const std::string path = temporary_path("coarse.csv");
      {
        std::ofstream file(path);
        file.precision(12);
        file << "time,q1,tau1\n";
        for (int k = first; k < 8000; ++k) {
          const double t = 0.001 * k;
          file << (k / group) * group * 0.001 << "," << std::sin(2 * t) << "," << std::cos(2 * t)
               << "\n";
        }
      }
      std::vector<runtime::Notice> notices;
      const Recording recording = runtime::read_recording(path, {}, &notices);
      ASSERT_EQ(recording.samples(), 8000 - first);
      EXPECT_EQ(recording.run_starts.size(), 1U);
      double worst = 0;
      for (Index k = group; k < recording.samples() - group; ++k) {
        worst =
            std::max(worst, std::abs(recording.time[k] - 0.001 * static_cast<double>(k + first)));
      }
      EXPECT_LT(worst, 1e-9);
      for (const auto& notice : notices) {
        EXPECT_EQ(notice.text().find("jumps"), std::string::npos) << notice.text();
        EXPECT_EQ(notice.text().find("gap"), std::string::npos) << notice.text();
      }
    }
  }
}

/// A velocity that a slower source gives: every third value is new.
VectorXd slow_column(bool pulsed) {
  VectorXd values(3000);
  for (Index k = 0; k < values.size(); ++k) {
    const Index fresh = k - k % 3;
    values[k] = pulsed && k != fresh ? 0 : std::sin(0.01 * static_cast<double>(fresh) + 0.1);
  }
  return values;
}

TEST(HeldColumns, AreFoundAndFilled) {
  const VectorXd time = VectorXd::LinSpaced(3000, 0, 2.999);
  for (const bool pulsed : {false, true}) {
    VectorXd values = slow_column(pulsed);
    const runtime::HeldColumn held = runtime::find_held(values);
    EXPECT_EQ(held.period, 3);
    EXPECT_EQ(held.pulsed, pulsed);
    runtime::fill_held(time, held, values);
    double worst = 0;
    for (Index k = 0; k < 2990; ++k) {
      worst = std::max(worst, std::abs(values[k] - std::sin(0.01 * static_cast<double>(k) + 0.1)));
    }
    EXPECT_LT(worst, 2e-4);
  }
}

TEST(HeldColumns, ACoarseSensorIsNone) {
  VectorXd values(5000);
  for (Index k = 0; k < values.size(); ++k) {
    values[k] = 0.024 * std::round(std::sin(0.01 * static_cast<double>(k)) / 0.024);
  }
  EXPECT_EQ(runtime::find_held(values).period, 1);
  values.setZero();
  EXPECT_EQ(runtime::find_held(values).period, 1);
}

TEST(HeldColumns, AreToldOfRecordings) {
  const std::string path = temporary_path("held.csv");
  const VectorXd held = slow_column(false), pulsed = slow_column(true);
  {
    std::ofstream file(path);
    file << "time,q1,tau1,qd1\n";
    for (Index k = 0; k < held.size(); ++k) {
      file << 0.001 * static_cast<double>(k) << "," << std::sin(0.01 * static_cast<double>(k))
           << "," << pulsed[k] << "," << held[k] << "\n";
    }
  }
  std::vector<runtime::Notice> notices;
  const Recording recording = runtime::read_recording(path, {}, &notices);
  std::string words;
  for (const auto& notice : notices) words += notice.text() + "\n";
  EXPECT_THAT(words, HasSubstr("tau1 has a value every 3 samples only, and 0 between them"));
  EXPECT_THAT(words, HasSubstr("qd1 changes every 3 samples only, and is held between"));
  EXPECT_NEAR(recording.dq(1000, 0), std::sin(10.1), 2e-4);
}

}  // namespace
}  // namespace dyngen::test
