// SPDX-License-Identifier: MIT
#include "runtime/recordings/writer.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>

#include "tests/runtime/recordings/recording_texts.h"

namespace dyngen::test {
namespace {

using runtime::Recording;

Recording random_recording(Eigen::Index samples, Eigen::Index joints) {
  std::mt19937 generator(20261121);
  std::normal_distribution<double> normal;
  const auto random = [&](Eigen::Index columns) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::NullaryExpr(samples, columns, [&] { return normal(generator); });
  };
  Recording recording;
  recording.time = Eigen::VectorXd::LinSpaced(samples, 0, 1.0 / 3);
  recording.q = random(joints);
  recording.tau = 1e4 * random(joints);
  recording.dq = 1e-300 * random(joints);
  recording.ddq = random(joints);
  recording.tau_sim = random(joints);
  recording.temperature = random(joints);
  recording.run_starts = {0, samples / 3, samples / 2};
  return recording;
}

/// A file that goes with the test.
struct TemporaryFile {
  explicit TemporaryFile(const std::string& name)
      : path((std::filesystem::path(testing::TempDir()) / name).string()) {}
  ~TemporaryFile() { std::filesystem::remove(path); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] std::string bytes() const {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::string path;
};

TEST(Writer, ReadingBackGivesTheSame) {
  const TemporaryFile file("dyngen_writer_test.csv");
  const Recording written = random_recording(300, 3);
  runtime::write_recording(written, file.path);
  std::vector<runtime::Notice> notices;
  const Recording read = runtime::read_recording(file.path, {}, &notices);
  EXPECT_TRUE(notices.empty());
  EXPECT_TRUE(same(read, written));
  EXPECT_EQ(read.file_name, file.path);
  EXPECT_FALSE(std::filesystem::exists(file.path + ".part"));
}

TEST(Writer, LeavesOutWhatWasNotRecorded) {
  const TemporaryFile file("dyngen_writer_short_test.csv");
  Recording written = random_recording(300, 1);
  written.run_starts = {0};
  written.dq.resize(0, 0);
  written.ddq.resize(0, 0);
  written.tau_sim.resize(0, 0);
  written.temperature.resize(0, 0);
  runtime::write_recording(written, file.path);
  EXPECT_TRUE(same(runtime::read_recording(file.path), written));
  EXPECT_EQ(file.bytes().substr(0, 13), "time,q1,tau1\n");
}

TEST(Writer, SaysWhatDoesNotFit) {
  Recording recording = random_recording(300, 3);
  recording.dq.resize(299, 3);
  try {
    runtime::write_recording(recording, "unused.csv");
    FAIL() << "nothing was thrown";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "write_recording(): qd is 299 x 3, expected 300 x 3");
  }
  recording = random_recording(300, 3);
  recording.run_starts = {0, 300};
  EXPECT_THROW(runtime::write_recording(recording, "unused.csv"), std::invalid_argument);
}

TEST(Writer, SaysWhyAFileCannotBeWritten) {
  try {
    runtime::write_recording(random_recording(300, 3), "/nowhere/run.csv");
    FAIL() << "nothing was thrown";
  } catch (const runtime::RecordingError& error) {
    EXPECT_STREQ(error.what(),
                 "/nowhere/run.csv: error: cannot write the file: No such file or directory");
  }
}

#ifdef DYNGEN_WITH_ZLIB

TEST(Gzip, ReadingBackGivesTheSame) {
  const TemporaryFile file("dyngen_writer_test.csv.gz");
  const Recording written = random_recording(5000, 3);
  runtime::write_recording(written, file.path);
  EXPECT_EQ(file.bytes().substr(0, 2), "\x1f\x8b");
  EXPECT_TRUE(same(runtime::read_recording(file.path), written));

  // told by its bytes: from memory, and under any name
  EXPECT_TRUE(same(read_text(file.bytes()).recording, written));
  // several members are one text: the second header stands among the rows
  EXPECT_NE(error_of(file.bytes() + file.bytes()).find(":5002:1: error: found 'time'"),
            std::string::npos);
}

TEST(Gzip, TruncatedIsRefused) {
  const TemporaryFile file("dyngen_truncated_test.csv.gz");
  runtime::write_recording(random_recording(5000, 3), file.path);
  const std::string bytes = file.bytes();
  for (const std::size_t size : {bytes.size() - 1, bytes.size() / 2, std::size_t{11}}) {
    const std::string message = error_of(bytes.substr(0, size));
    EXPECT_NE(message.find(": error: found the end of the file within a gzip stream"),
              std::string::npos)
        << message;
    EXPECT_EQ(message.rfind("run.csv:", 0), 0U) << message;
  }
}

TEST(Gzip, CorruptIsRefused) {
  const TemporaryFile file("dyngen_corrupt_test.csv.gz");
  runtime::write_recording(random_recording(5000, 3), file.path);
  std::string bytes = file.bytes();
  bytes[bytes.size() - 6] ^= 1;  // of the checksum
  EXPECT_NE(error_of(bytes).find("error: found a corrupt gzip stream (incorrect data check)"),
            std::string::npos)
      << error_of(bytes);
  EXPECT_NE(error_of(file.bytes() + "rest").find("error: found a corrupt gzip stream"),
            std::string::npos);
}

#endif

}  // namespace
}  // namespace dyngen::test
