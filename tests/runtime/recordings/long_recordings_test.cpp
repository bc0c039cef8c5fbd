// SPDX-License-Identifier: MIT
// Recordings that are too long to be read whole, and files that continue one another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "runtime/identification/recording_clock.h"
#include "runtime/identification/stretches.h"
#include "runtime/recordings/writer.h"
#include "tests/support/temporary_path.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using runtime::MotionOptions;
using runtime::MotionSource;
using runtime::Recording;

/// One joint at 50 Hz that moves far in the first tenth alone: all that is most telling is there.
Recording slow_day(double seconds, double start) {
  constexpr double kStep = 0.02;
  const auto samples = static_cast<Index>(seconds / kStep);
  Recording recording;
  recording.time =
      start + Eigen::ArrayXd::LinSpaced(samples, 0, kStep * static_cast<double>(samples - 1));
  recording.q.resize(samples, 1);
  for (Index k = 0; k < samples; ++k) {
    const double t = recording.time[k] - start;
    const double fast = 1 / (1 + std::exp((t - seconds / 10) / 5));
    recording.q(k, 0) = (0.2 + 0.8 * fast) * std::sin(1.5 * t);
  }
  recording.tau = 2 * recording.q;
  recording.run_starts = {0};
  return recording;
}

std::string file_of(const Recording& recording, const std::string& name) {
  const std::string path = temporary_path(name);
  runtime::write_recording(recording, path);
  return path;
}

/// The file of 2000 s as 100 s of stretches.
MotionSource read_as_long(const std::string& path) {
  MotionOptions options;
  options.average_periods = false;
  options.state.cutoff_hz = 5;
  options.numbers_above = runtime::numbers_of_rows(10000, 1, 0.02);
  options.numbers_of_stretches = runtime::numbers_of_rows(5000, 1, 0.02);
  options.read_whole = 300;
  return runtime::motion_of_file(path, options);
}

TEST(Stretches, AreSpreadOverTheWholeRecording) {
  const MotionSource source = read_as_long(file_of(slow_day(2000, 0), "long.csv"));
  const auto& stretches = source.condition.stretches;
  std::vector<int> in_fifth(5, 0);
  double used = 0;
  for (const auto& [from, to] : stretches) {
    ++in_fifth[static_cast<std::size_t>(std::min(4.0, from / 400))];
    used += to - from;
  }
  for (const int count : in_fifth) EXPECT_GE(count, 1);
  EXPECT_LE(used, 100.0);
  EXPECT_GE(used, 80.0);
}

TEST(Stretches, KeepTheTimeSinceTheStartOfTheRecording) {
  const MotionSource source = read_as_long(file_of(slow_day(2000, 5000), "stamped.csv"));
  EXPECT_NEAR(source.start, 5000, 1e-9);
  EXPECT_GE(source.condition.stretches.front().first, 0);
  double first = 1e9, last = 0;
  source.pieces([&](const runtime::StreamPiece& piece) {
    first = std::min(first, piece.motion.time[0] - source.start);
    last = std::max(last, piece.motion.time[piece.motion.samples() - 1] - source.start);
  });
  EXPECT_GE(first, source.condition.stretches.front().first);
  EXPECT_LE(last, 2000);
  EXPECT_GE(last, 1800);
  ASSERT_FALSE(source.condition.messages.empty());
  EXPECT_NE(source.condition.messages.front().find("long recording: of "), std::string::npos)
      << source.condition.messages.front();
}

TEST(Stretches, AreNotReadOfAShortRecording) {
  EXPECT_TRUE(read_as_long(file_of(slow_day(290, 0), "short.csv")).condition.stretches.empty());
}

MotionSource begun_at(double start, double seconds, const std::string& name) {
  MotionOptions options;
  options.average_periods = false;
  options.state.cutoff_hz = 5;
  Recording recording = slow_day(seconds, start);
  recording.file_name = name;
  return runtime::motion_of(std::move(recording), options);
}

TEST(RecordingClock, GoesOnInFilesThatContinueOneAnother) {
  const auto clocked = runtime::on_one_clock(
      {begun_at(200, 90, "b"), begun_at(100, 90, "a"), begun_at(900, 90, "c")}, 600);
  EXPECT_NEAR(clocked.sources[0].start, 100, 1e-9);  // the order stays
  EXPECT_NEAR(clocked.sources[1].start, 100, 1e-9);
  EXPECT_NEAR(clocked.sources[2].start, 900, 1e-9);  // after more than the longest pause
  EXPECT_EQ(clocked.sentence, "b continues a: time counts from the start of a");
}

TEST(RecordingClock, IsEachFilesOwnWhereStampsOverlap) {
  const auto clocked = runtime::on_one_clock({begun_at(0, 90, "a"), begun_at(0, 90, "b")}, 600);
  EXPECT_EQ(clocked.sources[1].start, 0);
  EXPECT_TRUE(clocked.sentence.empty());
}

}  // namespace
}  // namespace dyngen::test
