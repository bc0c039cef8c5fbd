// SPDX-License-Identifier: MIT
#include "runtime/recordings/reader.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/runtime/recordings/recording_texts.h"

namespace dyngen::test {
namespace {

using runtime::Recording;
using runtime::RecordingReader;

TEST(Reader, ReadsAPlainRecordingWithoutNotices) {
  const ReadResult result = read_text(joined(plain_lines(100)));
  const Recording& recording = result.recording;
  EXPECT_TRUE(result.notices.empty());
  EXPECT_EQ(recording.file_name, "run.csv");
  ASSERT_EQ(recording.samples(), 100);
  ASSERT_EQ(recording.joints(), 2);
  EXPECT_EQ(recording.run_starts, std::vector<Eigen::Index>{0});
  EXPECT_EQ(recording.time(99), 0.099);
  EXPECT_EQ(recording.q(99, 0), 99);
  EXPECT_EQ(recording.q(99, 1), -99);
  EXPECT_EQ(recording.tau(99, 0), 49.5);
  EXPECT_EQ(recording.tau(99, 1), 7);
  EXPECT_EQ(recording.dq.size() + recording.ddq.size() + recording.tau_sim.size(), 0);
  EXPECT_EQ(recording.temperature.size(), 0);
}

TEST(Reader, TakesColumnsInAnyOrderAndSpelling) {
  std::string text = "Segment, \"TAU1\" , temp1,temp2,DQ1 ,ddq1, tausim1,Q1,TIME\n";
  for (int k = 0; k < 20; ++k) {
    text += k < 10 ? "a" : "b";
    text += ", 1,2 , 3,+4,\"5\",6,7," + std::to_string(k) + "e-3\n";
  }
  const ReadResult result = read_text(text);
  const Recording& recording = result.recording;
  EXPECT_TRUE(result.notices.empty()) << result.notices.front();
  EXPECT_EQ(recording.run_starts, (std::vector<Eigen::Index>{0, 10}));
  EXPECT_EQ(recording.tau(3, 0), 1);
  EXPECT_EQ(recording.temperature(3, 0), 2);
  EXPECT_EQ(recording.temperature(3, 1), 3);
  EXPECT_EQ(recording.dq(3, 0), 4);
  EXPECT_EQ(recording.ddq(3, 0), 5);
  EXPECT_EQ(recording.tau_sim(3, 0), 6);
  EXPECT_EQ(recording.q(3, 0), 7);
  EXPECT_EQ(recording.time(3), 0.003);
}

TEST(Reader, SaysWhichChunkContinuesARun) {
  std::vector<std::string> lines = plain_lines(40);
  lines[0] += ",segment";
  for (std::size_t i = 1; i < lines.size(); ++i) lines[i] += i <= 20 ? ",1" : ",2";
  RecordingReader reader = RecordingReader::from_text(joined(lines), "run.csv");
  EXPECT_EQ(reader.joints(), 2);
  Recording chunk;
  ASSERT_TRUE(reader.next(chunk, 15));
  EXPECT_FALSE(reader.continues_run());
  EXPECT_EQ(chunk.run_starts, std::vector<Eigen::Index>{0});
  ASSERT_TRUE(reader.next(chunk, 15));
  EXPECT_TRUE(reader.continues_run());
  EXPECT_EQ(chunk.run_starts, (std::vector<Eigen::Index>{0, 5}));
  ASSERT_TRUE(reader.next(chunk, 15));
  EXPECT_TRUE(reader.continues_run());
  EXPECT_EQ(chunk.samples(), 10);
  EXPECT_EQ(reader.fraction_read(), 1);
  EXPECT_FALSE(reader.next(chunk, 15));
  EXPECT_EQ(chunk.samples(), 0);
  EXPECT_FALSE(reader.next(chunk, 15));
}

TEST(Reader, WantsAtLeastOneRow) {
  RecordingReader reader = RecordingReader::from_text(joined(plain_lines(10)), "run.csv");
  Recording chunk;
  EXPECT_THROW(reader.next(chunk, 0), std::invalid_argument);
}

TEST(Reader, KeepsAFewNoticesAndCountsTheRest) {
  std::vector<std::string> lines = plain_lines(10);
  for (int i = 0; i < 30; ++i) lines[0] += ",extra" + std::to_string(i);
  for (std::size_t i = 1; i < lines.size(); ++i) lines[i] += std::string(30, ',');
  runtime::ReadOptions options;
  options.max_notices = 5;
  const ReadResult result = read_text(joined(lines), options);
  ASSERT_EQ(result.notices.size(), 6U);
  EXPECT_EQ(result.notices[0],
            "run.csv:1:22: warning: found column 'extra0', which means nothing here; ignored");
  EXPECT_EQ(result.notices[5], "run.csv: warning: 25 more notices are left out");
}

TEST(Reader, FractionReadRisesToOne) {
  RecordingReader reader = RecordingReader::from_text(joined(plain_lines(100000)), "run.csv");
  Recording chunk;
  double before = 0;
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(reader.next(chunk, 10000));
    EXPECT_GE(reader.fraction_read(), before);
    EXPECT_NEAR(reader.fraction_read(), (i + 1) / 10.0, 0.15);  // buffers of 256 kB in 2.3 MB
    before = reader.fraction_read();
  }
  EXPECT_EQ(before, 1);
}

}  // namespace
}  // namespace dyngen::test
