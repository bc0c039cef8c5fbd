// SPDX-License-Identifier: MIT
// What dyngen and dynid print fits a terminal of 80 columns.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "gen/diagnostic/utf8.h"
#include "gen/tool/fitted_lines.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/runtime/dynid/multisine.h"
#include "tests/runtime/dynid/run_dynid.h"

namespace dyngen::runtime {
namespace {

namespace fs = std::filesystem;

using test::dynid;

TEST(FittedLine, BreaksAtBlanksAndAlignsWhatFollows) {
  EXPECT_EQ(fitted_line("short", 10), "short");
  EXPECT_EQ(fitted_line("one two three four", 10), "one two\n  three\n  four");
  EXPECT_EQ(fitted_line("  one two three", 10), "  one two\n    three");
  EXPECT_EQ(fitted_line("  --name    its meaning is long", 24),
            "  --name    its meaning\n            is long");
  EXPECT_EQ(fitted_line("a " + std::string(20, 'b') + " c", 10),
            "a\n  " + std::string(20, 'b') + "\n  c");
  EXPECT_EQ(fitted_line("h\xC3\xA4ngt nicht", 11), "h\xC3\xA4ngt nicht");
}

TEST(FittedLine, AWrappedCommentStaysAComment) {
  // the map that 'dynid import --guess' prints stays a map
  EXPECT_EQ(fitted_line("# one two three", 10), "# one two\n# three");
}

TEST(FittedLine, LeavesPlacesAndLinesOfFilesAlone) {
  for (const std::string line :
       {"arm.robot:4:7: error: a long sentence that goes on", "run.csv:17: warning: another one",
        "    4 | d 0 0 0 0 0 0 0 0 0 0 0", "      |       ^~ declared names: a, b, c, d"}) {
    EXPECT_EQ(fitted_line(line, 20), line);
  }
  EXPECT_NE(fitted_line("arm.robot: error: a long sentence", 20).find('\n'), std::string::npos);
}

TEST(FittedLines, WritesWholeLinesAndProgressAtOnce) {
  std::ostringstream stream;
  {
    FittedLines lines(stream, 10);
    stream << "one two"
           << " three\n"
           << "\rprogress of a long name" << std::flush;
    EXPECT_EQ(stream.rdbuf()->pubsync(), 0);
    stream << "rest";
  }
  EXPECT_EQ(stream.str(), "one two\n  three\n\rprogress of a long namerest");
}

/// Lines of more than 80 characters that are not allowed to be.
std::vector<std::string> long_lines(const std::string& text) {
  static const std::regex place(R"(^\S+:\d+(:\d+)?: (error|warning): .*)");
  static const std::regex file_line(R"(^ *\d* *\| .*)");
  std::vector<std::string> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (character_count(line) <= 80) continue;
    if (std::regex_match(line, place) || std::regex_match(line, file_line)) continue;
    const std::size_t word = line.find_first_not_of(' ');
    if (line.find(' ', word) == line.npos) continue;  // a path
    found.push_back(line);
  }
  return found;
}

class TerminalLines : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::path(testing::TempDir()) / ("terminal_lines_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    const DescribedRobot robot = describe_robot(kRobot, OpenParameters::kAbsentRows);
    for (const std::uint64_t seed : {1U, 2U}) {
      Recording recording =
          test::multisine(robot.linear, test::plausible_beta(robot.linear, 1),
                          {.seconds = 10, .sample_time = 0.004, .torque_noise = 0.3, .seed = seed});
      recording.dq.resize(0, 0);
      recording.ddq.resize(0, 0);
      write_recording(recording, path("run" + std::to_string(seed) + ".csv"));
    }
  }

  static std::string path(const std::string& name) { return (folder_ / name).string(); }

  static void expect_fits(const std::string& call) {
    const std::string out = dynid(call, "DYNGEN_COLUMNS=80").out;
    EXPECT_FALSE(out.empty()) << call;
    for (const std::string& line : long_lines(out)) ADD_FAILURE() << call << ":\n" << line;
  }
  static void expect_dyngen_fits(const std::string& arguments) {
    const std::string out = test::run_shell("DYNGEN_COLUMNS=80 " DYNGEN " " + arguments).out;
    EXPECT_FALSE(out.empty()) << arguments;
    for (const std::string& line : long_lines(out)) ADD_FAILURE() << arguments << ":\n" << line;
  }

  static constexpr const char* kRobot = DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot";
  static fs::path folder_;
};
fs::path TerminalLines::folder_;

TEST_F(TerminalLines, OfHelpAndVersion) {
  expect_fits("--help");
  expect_fits("--version");
  for (const char* command : {"fit", "check", "accumulate", "merge", "simulate", "excite", "atlas",
                              "effects", "diagnose"}) {
    expect_fits(std::string(command) + " --help");
  }
  expect_dyngen_fits("--help");
}

TEST_F(TerminalLines, OfDyngen) {
  const std::string robots = DYNGEN_SOURCE_DIR "/robots/";
  for (const char* name : {"planar2r", "puma560", "puma560_3dof", "scara", "sarcos_grla"}) {
    expect_dyngen_fits(robots + name + ".robot --explain");
  }
  expect_dyngen_fits(robots + "puma560.robot --count");
  expect_dyngen_fits(robots + "puma560.robot --functions nothing -o x.c");
  expect_dyngen_fits(robots + "planar2r.robot --parameters other -o x.c");
  std::ofstream(path("light.robot")) << "number_link 2\nd 0 1\nZZ 1 0\ngy 9.81\nstop\n";
  expect_dyngen_fits(path("light.robot") + " --count");
}

TEST_F(TerminalLines, OfFits) {
  const std::string robot = std::string(" ") + kRobot + " ";
  const std::string runs = path("run1.csv") + " --holdout " + path("run2.csv");
  expect_fits("fit" + robot + runs + " -o " + path("id.robot"));
  expect_fits("fit" + robot + runs + " --method all");
  expect_fits("check " + path("id.robot") + " " + path("run2.csv"));
  expect_fits("accumulate" + robot + path("run1.csv") + " -o " + path("a.qr"));
  expect_fits("accumulate" + robot + path("run2.csv") + " -o " + path("b.qr"));
  expect_fits("merge " + path("a.qr") + " " + path("b.qr") + " -o " + path("c.qr"));
  expect_fits("fit" + robot + path("c.qr"));
  expect_fits("fit" + robot + path("none.csv"));
  expect_fits("fit" + robot + path("run1.csv") + " --method iv");
}

TEST_F(TerminalLines, OfAtlasEffectsAndDiagnosis) {
  const std::string robot = std::string(" ") + kRobot + " ";
  expect_fits("effects");
  expect_fits("effects stribeck");
  expect_fits("effects lugre");
  expect_fits("atlas" + robot + path("run1.csv"));
  expect_fits("diagnose" + robot + path("run1.csv") + " --holdout " + path("run2.csv"));
}

#ifdef DYNGEN_WITH_NLOPT
TEST_F(TerminalLines, OfExcitation) {
  const std::string limits = " --evaluations 60 --starts 1 -o ";
  expect_fits("excite " + std::string(kRobot) + limits + path("t.csv"));
  const std::string puma = DYNGEN_SOURCE_DIR "/robots/puma560_3dof.robot";
  expect_fits("excite " + puma + limits + path("t.csv"));
}
#endif

#ifdef DYNGEN_WITH_BOOST
TEST_F(TerminalLines, OfSimulations) {
  std::ofstream(path("move.csv")) << "time,q1,q2\n0,0,0\n1,0.5,0.2\n2,0.2,0.4\n";
  const std::string robot = DYNGEN_SOURCE_DIR "/robots/planar2r.robot";
  for (const char* controller : {"pd", "ff", "ct", "gravity"}) {
    expect_fits("simulate " + robot + " --trajectory " + path("move.csv") + " --controller " +
                controller + " -o " + path("run.csv"));
  }
}
#endif

}  // namespace
}  // namespace dyngen::runtime
