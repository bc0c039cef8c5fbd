// SPDX-License-Identifier: MIT
#include "runtime/identification/summary_file.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/fleet/fleet_recordings.h"

namespace dyngen::runtime {
namespace {

/// CRC-32, bit by bit.
std::string checksum(const std::string& bytes) {
  std::uint32_t sum = 0xFFFFFFFFU;
  for (const char c : bytes) {
    sum ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ ((sum & 1U) != 0 ? 0xEDB88320U : 0);
  }
  std::string text;
  for (int i = 0; i < 4; ++i) text += static_cast<char>((~sum >> (8 * i)) & 0xFFU);
  return text;
}

const RobotSummaries& two_robots() {
  static const RobotSummaries all = [] {
    const DescribedRobot robot =
        describe_robot(DYNGEN_SOURCE_DIR "/robots/planar2r.robot", OpenParameters::kAbsentRows);
    RobotSummaries made = empty_summaries(robot.linear);
    for (const unsigned seed : {1U, 2U}) {
      const auto recording = test::fleet_recording(robot.linear, seed, {.seconds = 5});
      made.robots.emplace(seed == 1 ? "" : "arm 2",
                          summarise(robot.linear, motion_of(recording, {}), {}));
    }
    return made;
  }();
  return all;
}

/// What the reader says of bytes that it refuses; empty if it does not.
std::string refusal(const std::string& bytes) {
  try {
    read_summaries(bytes, "part.qr");
    return "";
  } catch (const SummaryFileError& error) {
    return error.what();
  }
}

void expect_equal(const TorqueFactor& a, const TorqueFactor& b) {
  EXPECT_EQ(a.columns, b.columns);
  EXPECT_EQ(a.parameters, b.parameters);
  ASSERT_EQ(a.joints.size(), b.joints.size());
  for (std::size_t j = 0; j < a.joints.size(); ++j) {
    EXPECT_EQ(a.joints[j].R, b.joints[j].R);
    EXPECT_EQ(a.joints[j].rows, b.joints[j].rows);
  }
}

TEST(SummaryFile, ReadsBackExactlyWhatWasWritten) {
  const RobotSummaries& all = two_robots();
  const std::string bytes = write_summaries(all);
  const RobotSummaries again = read_summaries(bytes, "part.qr");
  EXPECT_EQ(again.model, all.model);
  EXPECT_EQ(again.joints, all.joints);
  EXPECT_EQ(again.parameters, all.parameters);
  ASSERT_EQ(again.robots.size(), 2U);
  for (const auto& [name, a] : all.robots) {
    const RecordingSummary& b = again.robots.at(name);
    expect_equal(a.equations, b.equations);
    expect_equal(a.regressor_noise, b.regressor_noise);
    EXPECT_EQ(a.noise.F, b.noise.F);
    EXPECT_EQ(a.noise.power, b.noise.power);
    EXPECT_EQ(a.noise.correlated_power, b.noise.correlated_power);
    EXPECT_EQ(a.extent.samples, b.extent.samples);
    EXPECT_EQ(a.extent.lowest, b.extent.lowest);
    EXPECT_EQ(a.extent.highest, b.extent.highest);
    EXPECT_EQ(a.extent.speed, b.extent.speed);
    EXPECT_EQ(a.extent.acceleration, b.extent.acceleration);
    EXPECT_EQ(a.row_time, b.row_time);
    EXPECT_EQ(a.lowest_cutoff, b.lowest_cutoff);
    EXPECT_EQ(a.highest_cutoff, b.highest_cutoff);
    EXPECT_EQ(a.recordings, b.recordings);
  }
  EXPECT_EQ(write_summaries(again), bytes);
}

TEST(SummaryFile, HoldsTheRecordingsOfAFleetForAYear) {
  RobotSummaries all = two_robots();
  all.robots.begin()->second.recordings = 10'000LL * 525'960;  // one a minute
  all.robots.begin()->second.equations.joints[0].rows = 1e13;
  const RobotSummaries again = read_summaries(write_summaries(all), "year.qr");
  EXPECT_EQ(again.robots.begin()->second.recordings, 5'259'600'000);
  EXPECT_EQ(again.robots.begin()->second.equations.joints[0].rows, 1e13);
}

TEST(SummaryFile, AnyFlippedByteIsRefusedByName) {
  const std::string bytes = write_summaries(two_robots());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ (1 << (i % 8)));
    const std::string reason = refusal(damaged);
    ASSERT_TRUE(reason.starts_with("part.qr: error: ")) << "byte " << i << ": " << reason;
    const char* expected = i < 8    ? "expected it to begin with 'dyngenqr'"
                           : i < 12 ? "of the format, expected 2"
                                    : "the checksum does not fit";
    ASSERT_NE(reason.find(expected), std::string::npos) << "byte " << i << ": " << reason;
  }
}

TEST(SummaryFile, AnyTruncationIsRefusedByName) {
  const std::string bytes = write_summaries(two_robots());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string reason = refusal(bytes.substr(0, size));
    ASSERT_TRUE(reason.starts_with("part.qr: error: ")) << size << " bytes: " << reason;
  }
  EXPECT_NE(refusal(bytes.substr(0, 14)).find("ends too early"), std::string::npos);
  EXPECT_NE(refusal(bytes.substr(0, bytes.size() / 2)).find("damaged or cut off"),
            std::string::npos);
  EXPECT_NE(refusal(bytes + "x").find("damaged"), std::string::npos);
}

TEST(SummaryFile, AnotherVersionIsRefusedEvenWhereTheChecksumFits) {
  std::string content = write_summaries(two_robots());
  content.resize(content.size() - 4);
  ASSERT_EQ(content + checksum(content), write_summaries(two_robots()));
  content[8] = 3;
  EXPECT_EQ(refusal(content + checksum(content)),
            "part.qr: error: version 3 of the format, expected 2");
}

TEST(SummaryFile, WrongContentIsRefusedEvenWhereTheChecksumFits) {
  const std::string bytes = write_summaries(two_robots());
  const std::string content = bytes.substr(0, bytes.size() - 4);
  std::string cut = content.substr(0, content.size() - 8);
  EXPECT_NE(refusal(cut + checksum(cut)).find("ends too early"), std::string::npos);
  const std::string more = content + "more";
  EXPECT_NE(refusal(more + checksum(more)).find("more bytes than expected"), std::string::npos);
  // the length of the model's name
  std::string huge = content;
  huge[15] = '\x7f';
  EXPECT_NE(refusal(huge + checksum(huge)).find("byte 16: a count of"), std::string::npos)
      << refusal(huge + checksum(huge));
  // exponent of the last acceleration
  std::string infinite = content;
  infinite[content.size() - 1] = '\x7f';
  infinite[content.size() - 2] = '\xf0';
  EXPECT_NE(refusal(infinite + checksum(infinite)).find("not finite"), std::string::npos);
}

TEST(SummaryFile, AFileThatIsNotThereIsNamedWithTheReason) {
  try {
    read_summary_file("absent.qr");
    FAIL();
  } catch (const SummaryFileError& error) {
    EXPECT_STREQ(error.what(), "absent.qr: error: cannot read: No such file or directory");
  }
}

}  // namespace
}  // namespace dyngen::runtime
