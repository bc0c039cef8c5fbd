// SPDX-License-Identifier: MIT
// The recordings of tests/data/cases, each damaged in one way that people report, and files like
// them: what is read is what the undamaged file holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "runtime/recordings/reader.h"
#include "runtime/recordings/time_base.h"
#include "tests/runtime/recordings/recording_texts.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using runtime::Recording;

struct ReadCase {
  Recording recording;
  std::vector<std::string> notices;  ///< without the file's name
};

ReadCase read_file(const std::string& path) {
  ReadCase result;
  std::vector<runtime::Notice> notices;
  result.recording = runtime::read_recording(path, {}, &notices);
  for (const runtime::Notice& notice : notices) {
    result.notices.push_back(notice.text().substr(path.size()));
  }
  return result;
}

std::string case_path(const std::string& name) {
  return DYNGEN_SOURCE_DIR "/tests/data/cases/" + name + "/run.csv.gz";
}

double largest_step(const Recording& recording) {
  double largest = 0;
  for (std::size_t run = 0; run < recording.run_starts.size(); ++run) {
    for (Index k = recording.run_starts[run] + 1; k < runtime::run_end(recording, run); ++k) {
      largest =
          std::max(largest, (recording.q.row(k) - recording.q.row(k - 1)).cwiseAbs().maxCoeff());
    }
  }
  return largest;
}

/// 10 s at 500 Hz of an arm that moves no faster than 3.5 rad/s (10 in the wrapped one).
void expect_good(const Recording& recording, Index samples, std::size_t runs,
                 double step = 0.0075) {
  EXPECT_EQ(recording.samples(), samples);
  EXPECT_EQ(recording.run_starts.size(), runs);
  EXPECT_EQ(recording.lines.size(), static_cast<std::size_t>(samples));
  EXPECT_LT(largest_step(recording), step);
  EXPECT_TRUE(runtime::examine_time_base(recording).uniform);
}

#ifdef DYNGEN_WITH_ZLIB

TEST(CaseRecordings, ARestartIsTwoRuns) {
  const ReadCase read = read_file(case_path("restart"));
  expect_good(read.recording, 5000, 2);
  EXPECT_EQ(read.recording.run_starts[1], 3000);
  ASSERT_EQ(read.notices.size(), 1U);
  EXPECT_EQ(read.notices[0],
            ":3002: warning: time starts again: found 0 s after 5.998 s; a new run begins here");
}

TEST(CaseRecordings, AGapIsTwoRuns) {
  const ReadCase read = read_file(case_path("gap"));
  expect_good(read.recording, 4988, 2);
  EXPECT_EQ(read.recording.run_starts[1], 100);
}

TEST(CaseRecordings, WrappedPositionsAreUnwrapped) {
  const ReadCase read = read_file(case_path("wrapped"));
  expect_good(read.recording, 5000, 1, 0.021);
  EXPECT_GT(read.recording.q.maxCoeff() - read.recording.q.minCoeff(), 6.4);
  ASSERT_EQ(read.notices.size(), 1U);
  EXPECT_EQ(read.notices[0],
            ":399: warning: q1 jumps by a whole turn, from 3.13256 to -3.13294; unwrapped (6 such "
            "jumps in all)");
}

TEST(CaseRecordings, AnEncoderGlitchIsInterpolated) {
  const ReadCase read = read_file(case_path("encoder_glitch"));
  expect_good(read.recording, 5000, 1);
  EXPECT_EQ(read.recording.lines[2500], 2502U);
  EXPECT_NEAR(read.recording.q(2500, 0), 0.44917787 - 1, 2e-4);
  ASSERT_EQ(read.notices.size(), 1U);
  EXPECT_EQ(read.notices[0],
            ":2502: warning: q1 is 0.449178 between -0.554052 and -0.547589; interpolated");
}

TEST(CaseRecordings, OtherFormsAreReadAlike) {
  const Recording plain = read_file(case_path("units_row")).recording;
  expect_good(plain, 5000, 1);
  const ReadCase sorted = read_file(case_path("shuffled_rows"));
  EXPECT_TRUE(same(sorted.recording, plain));
  ASSERT_EQ(sorted.notices.size(), 1U);
  EXPECT_NE(sorted.notices[0].find("rows that are not in the order of time"), std::string::npos);
  const ReadCase commas = read_file(case_path("quoted_decimal_commas"));
  EXPECT_TRUE(same(commas.recording, plain));
  EXPECT_TRUE(commas.notices.empty());
}

TEST(CaseRecordings, BurstsOfBadValuesAreGaps) {
  const ReadCase read = read_file(case_path("nan_bursts"));
  expect_good(read.recording, 4820, 16);
  EXPECT_TRUE(read.recording.q.allFinite() && read.recording.tau.allFinite());
  ASSERT_EQ(read.notices.size(), 1U);
  EXPECT_NE(read.notices[0].find("a new run begins after them (15 such in all"), std::string::npos);
}

TEST(CaseRecordings, WithoutAHeaderTheAnswerSaysWhatToDo) {
  const std::string path = case_path("headerless");
  try {
    read_file(path);
    FAIL() << "nothing was thrown";
  } catch (const runtime::RecordingError& error) {
    EXPECT_EQ(std::string(error.what()).substr(path.size()),
              ":1:1: error: found numbers in the first line, expected a header: put a line before "
              "it that names its 5 columns, such as 'time,q1,q2,tau1,tau2' if that is their order "
              "(names of other columns are free)");
  }
}

#endif

/// A file of some text that goes with the test.
class TextFile {
 public:
  explicit TextFile(const std::string& text)
      : path_((std::filesystem::path(testing::TempDir()) /
               (std::string("dyngen_case_") +
                testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv"))
                  .string()) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TextFile() { std::filesystem::remove(path_); }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

ReadCase read_lines(const std::vector<std::string>& lines) {
  const TextFile file(joined(lines));
  return read_file(file.path());
}

TEST(CaseRecordings, ShuffledRowsAreSorted) {
  const std::vector<std::string> ordered = plain_lines(400);
  const Recording plain = read_lines(ordered).recording;
  std::mt19937 generator(2);
  std::vector<std::string> random = ordered, reversed = ordered, blocks = {ordered[0]},
                           twice = ordered;
  std::shuffle(random.begin() + 1, random.end(), generator);
  std::reverse(reversed.begin() + 1, reversed.end());
  for (const int block : {3, 1, 0, 2, 7, 5, 4, 6}) {
    blocks.insert(blocks.end(), ordered.begin() + 1 + 50 * block,
                  ordered.begin() + 51 + 50 * block);
  }
  twice.push_back(ordered[20]);
  std::shuffle(twice.begin() + 1, twice.end(), generator);
  for (const auto& lines : {random, reversed, blocks, twice}) {
    const ReadCase read = read_lines(lines);
    EXPECT_TRUE(same(read.recording, plain));
    ASSERT_FALSE(read.notices.empty());
    EXPECT_NE(read.notices[0].find("; sorted by time"), std::string::npos);
    EXPECT_EQ(lines.at(read.recording.lines[7] - 1), ordered[8]);  // the row's own line
  }
}

TEST(CaseRecordings, ShuffledRowsAreSortedWithinTheirSegment) {
  std::vector<std::string> lines = plain_lines(100);
  for (std::size_t i = 1; i <= 100; ++i) lines[i] += ",a";
  for (std::size_t i = 1; i <= 100; ++i) {
    lines.push_back(lines[i].substr(0, lines[i].size() - 1) + "b");
  }
  lines[0] += ",segment";
  const Recording plain = read_lines(lines).recording;
  ASSERT_EQ(plain.run_starts, (std::vector<Index>{0, 100}));
  // the first row stays: its segment is the first
  std::mt19937 generator(3);
  std::shuffle(lines.begin() + 2, lines.end(), generator);
  const ReadCase read = read_lines(lines);
  EXPECT_TRUE(same(read.recording, plain));
}

TEST(CaseRecordings, RunsThatStartAgainAreNotSorted) {
  const std::vector<std::string> once = plain_lines(50);
  std::vector<std::string> lines = once;
  for (int run = 1; run < 6; ++run) {
    for (std::size_t i = 1; i < once.size(); ++i) {
      lines.push_back(once[i] + (run % 2 == 0 ? "" : ".5"));  // other torques
    }
  }
  const ReadCase read = read_lines(lines);
  EXPECT_EQ(read.recording.samples(), 300);
  EXPECT_EQ(read.recording.run_starts, (std::vector<Index>{0, 50, 100, 150, 200, 250}));
}

TEST(CaseRecordings, BurstsOfAnyLength) {
  for (const std::size_t burst : {1U, 4U, 10U, 11U, 30U}) {
    std::vector<std::string> lines = plain_lines(1000);
    std::size_t bad = 0;
    for (std::size_t at = 50; bad + burst <= 45 || burst > 10; at += 100) {
      if (at + burst > 950) break;
      for (std::size_t i = at; i < at + burst; ++i) {
        lines[i] = lines[i].substr(0, 6) + ",NaN,NaN,1";
        ++bad;
      }
    }
    const ReadCase read = read_lines(lines);
    if (burst <= 10) {
      EXPECT_EQ(read.recording.samples(), 1000) << burst;
      EXPECT_EQ(read.recording.run_starts.size(), 1U) << burst;
    } else {
      EXPECT_EQ(read.recording.samples(), 1000 - static_cast<Index>(bad)) << burst;
      EXPECT_EQ(read.recording.run_starts.size(), bad / burst + 1) << burst;
    }
    EXPECT_TRUE(read.recording.tau.allFinite());
    EXPECT_EQ(read.notices.size(), 1U);
  }
}

TEST(CaseRecordings, NoticesComeWithARefusalToo) {
  std::vector<std::string> lines = plain_lines(40);
  lines.insert(lines.begin() + 10, "# a comment");
  lines.push_back("0.040,40,off,20,7");
  const TextFile file(joined(lines));
  std::vector<runtime::Notice> notices;
  EXPECT_THROW(runtime::read_recording(file.path(), {}, &notices), runtime::RecordingError);
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_EQ(notices[0].line, 11U);
}

TEST(CaseRecordings, ATrajectoryIsNotRepaired) {
  std::vector<std::string> lines = {"time,q1"};
  for (int k = 0; k < 100; ++k) {
    lines.push_back(std::to_string(0.002 * k) + "," + (k == 50 ? "1" : std::to_string(0.001 * k)));
  }
  const TextFile file(joined(lines));
  runtime::ReadOptions options;
  options.torque_required = false;
  EXPECT_EQ(runtime::read_recording(file.path(), options).q(50, 0), 1);
}

}  // namespace
}  // namespace dyngen::test
