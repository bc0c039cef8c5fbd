// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/fit/file_summaries.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "runtime/identification/common_cutoff.h"
#include "runtime/identification/summary_file.h"
#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/process/message.h"
#include "tests/fleet/fleet_recordings.h"

namespace dyngen::runtime {
namespace {

TEST(Message, ReadsBackAnyBytes) {
  const Message message = {"file", "", std::string("a\0b\n", 4), std::string(300, '\xff')};
  EXPECT_EQ(unpacked(packed(message)), message);
  EXPECT_EQ(unpacked(packed({})), Message{});
  const std::string bytes = packed(message);
  EXPECT_THROW(unpacked(bytes.substr(0, bytes.size() - 1)), std::runtime_error);
}

class FileSummariesTest : public testing::Test {
 protected:
  FileSummariesTest() {
    std::filesystem::create_directories(folder_);
    for (unsigned i = 0; i < 3; ++i) {
      paths_.push_back(folder_ + "/" + std::to_string(i) + ".csv");
      write_recording(test::fleet_recording(robot_.linear, i + 1, {.seconds = 5}), paths_.back());
    }
  }
  ~FileSummariesTest() override { std::filesystem::remove_all(folder_); }

  std::string bytes_of(const std::vector<std::string>& paths, FileSummaries& found) {
    ToolOptions options;
    options.recordings = paths;
    ProcessGroup alone;
    ProgressLine progress("test");
    found = summarise_files(robot_, options, alone, progress);
    RobotSummaries all = empty_summaries(robot_.linear);
    all.robots.emplace("", found.sum);
    return write_summaries(all);
  }

  const std::string folder_ = testing::TempDir() + "dyngen_file_summaries_" +
                              testing::UnitTest::GetInstance()->current_test_info()->name();
  DescribedRobot robot_ =
      describe_robot(DYNGEN_SOURCE_DIR "/robots/planar2r.robot", OpenParameters::kAbsentRows);
  std::vector<std::string> paths_;
};

TEST_F(FileSummariesTest, AreMergedInTheOrderOfTheList) {
  FileSummaries found;
  RecordingSummary sum = empty_summary(robot_.linear.columns, robot_.linear.size());
  for (const std::string& path : paths_) {
    const MotionSource recorded = motion_of_file(path, {});
    const Cutoff cutoff = common_cutoff(robot_.linear, {recorded});
    merge(sum, summarise(robot_.linear, at_cutoff({recorded}, cutoff).front(), {}));
  }
  RobotSummaries all = empty_summaries(robot_.linear);
  all.robots.emplace("", sum);
  EXPECT_EQ(bytes_of(paths_, found), write_summaries(all));
  EXPECT_TRUE(found.notes.empty());
  EXPECT_TRUE(found.left_out.empty());
}

TEST_F(FileSummariesTest, MixRecordingsAndQrFiles) {
  RobotSummaries second = empty_summaries(robot_.linear);
  second.robots.emplace("", summarise(robot_.linear, motion_of_file(paths_[1], {}), {}));
  const std::string path = folder_ + "/1.qr";
  std::ofstream(path, std::ios::binary) << write_summaries(second);
  FileSummaries found;
  EXPECT_EQ(bytes_of({paths_[0], path, paths_[2]}, found), bytes_of(paths_, found));
}

TEST_F(FileSummariesTest, LeaveOutByNameWhatCannotBeUsed) {
  const std::string absent = folder_ + "/absent.csv", text = folder_ + "/text.csv",
                    other = folder_ + "/other.qr", three = folder_ + "/three.csv";
  std::ofstream(text) << "this is no recording\n";
  const DescribedRobot puma =
      describe_robot(DYNGEN_SOURCE_DIR "/robots/puma560_3dof.robot", OpenParameters::kAbsentRows);
  std::ofstream(other, std::ios::binary) << write_summaries(empty_summaries(puma.linear));
  write_recording(test::fleet_recording(puma.linear, 1, {.seconds = 5}), three);
  FileSummaries all, some;
  testing::internal::CaptureStderr();
  const std::string with = bytes_of({absent, paths_[0], text, other, paths_[2], three}, some);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(with, bytes_of({paths_[0], paths_[2]}, all));
  EXPECT_EQ(some.left_out, (std::vector<std::string>{absent, text, other, three}));
  ASSERT_EQ(some.notes.size(), 1U);
  EXPECT_EQ(some.notes[0], "left out: " + absent + ", " + text + ", " + other + ", " + three);
  for (const std::string& part :
       {absent + ": ", text + ":1", other + ": error: it is not of planar2r: joint 1",
        three + ": 3 joints, but planar2r has 2"}) {
    EXPECT_NE(said.find(part), std::string::npos) << part << " in:\n" << said;
  }
}

TEST_F(FileSummariesTest, RefuseAListWithoutAnyGoodFile) {
  FileSummaries found;
  testing::internal::CaptureStderr();
  EXPECT_THROW(bytes_of({folder_ + "/a.csv", folder_ + "/b.csv"}, found), std::invalid_argument);
  testing::internal::GetCapturedStderr();
}

}  // namespace
}  // namespace dyngen::runtime
