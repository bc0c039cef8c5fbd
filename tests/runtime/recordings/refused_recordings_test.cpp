// SPDX-License-Identifier: MIT
// What cannot be read: the message says where, what was found and what was expected.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/runtime/recordings/recording_texts.h"

namespace dyngen::test {
namespace {

struct Refusal {
  const char* claim;
  std::string text;
  std::string message;
};

std::string with_header(const std::string& header) { return with_line(20, 1, header); }

std::vector<Refusal> refusals() {
  const std::string expected_header = "expected a header such as 'time,q1,q2,tau1,tau2'";
  std::vector<std::string> scattered = plain_lines(500);
  for (std::size_t i = 10; i < 500; i += 10) {
    const std::size_t comma = scattered[i].rfind(',');
    scattered[i].replace(comma + 1, std::string::npos, "1e99");
  }
  std::vector<std::string> unrecorded = plain_lines(500);
  for (std::size_t i = 100; i < 400; ++i) unrecorded[i] = unrecorded[i].substr(0, 5) + ",nan,1,1,1";
  std::string binary = joined(plain_lines(20));
  binary[40] = '\0';
  std::vector<std::string> short_runs = {"time,q1,tau1"};
  for (int k = 0; k < 40; ++k) short_runs.push_back(std::to_string(k % 4) + "e-3,1,2");
  return {
      {"an empty file", "", "run.csv: error: found an empty file, expected a recording"},
      {"comments only", "# nothing\n\n",
       "run.csv:2:1: error: found no header, expected 'time,q1,...,tau1,...'"},
      {"a header only", "time,q1,tau1\n",
       "run.csv:1:1: error: found no rows of data after the header, expected two or more"},
      {"one sample", "time,q1,tau1\n0,1,2\n",
       "run.csv:2:1: error: found one row of data, expected two or more"},
      {"no header", "0,1,2\n1,2,3\n",
       "run.csv:1:1: error: found numbers in the first line, expected a header: put a line before "
       "it that names its 3 columns, such as 'time,q1,tau1' if that is their order (names of other "
       "columns are free)"},
      {"no header, of many columns", "0;1;2;3;4;5;6;7;8;9\n",
       "run.csv:1:1: error: found numbers in the first line, expected a header: put a line before "
       "it that names its 10 columns, such as 'time;q1;...;q4;tau1;...;tau4;x1' if that is their "
       "order (names of other columns are free)"},
      {"a unit that is none", with_line(20, 2, "s,rad,furlong,Nm,Nm"),
       "run.csv:2:7: error: found unit 'furlong' of column 'q2', expected rad, deg, turn, m, mm or "
       "the like"},
      {"a unit of something else", with_line(20, 2, "[s],[rad],[rad],[Nm],[A]"),
       "run.csv:2:22: error: found unit 'A' of column 'tau2', expected N m, mN m, N mm, N cm, kN "
       "m, "
       "N, mN or kN"},
      {"a unit in a name that is none", with_header("time,q1 [deg],q2 [counts],tau1,tau2"),
       "run.csv:1:15: error: found unit 'counts' of 'q2 [counts]', expected rad, deg, turn, m, mm "
       "or the like"},
      {"a million N m", with_header("time,q1,q2,tau1 (MNm),tau2"),
       "run.csv:1:12: error: found unit 'MNm' of 'tau1 (MNm)', expected N m, mN m, N mm, N cm, kN "
       "m, N, mN or kN"},
      {"units that contradict each other",
       joined({"time,q1 [deg],tau1", "s,rad,Nm", "0,1,2", "1,2,3"}),
       "run.csv:2:3: error: found unit 'rad' of column 'q1 [deg]', expected the unit in its name, "
       "or none"},
      {"commas that part thousands, or not", joined({"time;q1;tau1", "0.1;1,234;2.5"}),
       "run.csv:2:5: error: found '1,234' in column q1 beside numbers with a decimal point, "
       "expected one decimal sign (does the comma part thousands?)"},
      {"decimal commas between commas", joined({"time,q1,tau1", "0,5,1,5,2,5"}),
       "run.csv:2:7: error: found 6 columns, expected 3 as in the header (line 1); numbers with a "
       "decimal comma need quotes, or semicolons between columns"},
      {"no time", with_header("t,q1,q2,tau1,tau2"),
       "run.csv:1:1: error: found no column 'time' in 't,q1,q2,tau1,tau2', " + expected_header +
           "; other names and units are read by a map ('dynid import --guess' writes one)"},
      {"no positions", with_header("time,a,b,tau1,tau2"),
       "run.csv:1:15: error: found no column 'q1', " + expected_header},
      {"no torques", with_header("time,q1,q2,x,y"),
       "run.csv:1:14: error: found no column 'tau1', " + expected_header},
      {"a missing torque", with_header("time,q1,q2,tau1,y"),
       "run.csv:1:12: error: found no column 'tau2', expected tau1 to tau2 for 2 joints"},
      {"a torque too many", with_header("time,q1,tau1,tau2,x"),
       "run.csv:1:14: error: found column 'tau2', expected tau1 to tau1 for 1 joints"},
      {"a gap in the numbering", with_header("time,q1,q3,tau1,tau2"),
       "run.csv:1:9: error: found column 'q3' without 'q2', expected q1, q2, ... with no gap"},
      {"numbers from 0", with_header("time,q0,q1,tau0,tau1"),
       "run.csv:1:6: error: found column 'q0', expected numbers from 1 to 1000"},
      {"a column twice", with_header("time,q1,q2,tau1,Tau1"),
       "run.csv:1:17: error: found column 'Tau1' for a second time (the first is 'tau1' in column "
       "12), expected each once"},
      {"velocities twice", "time,q1,tau1,qd1,dq1\n",
       "run.csv:1:18: error: found column 'dq1' for a second time (the first is 'qd1' in column "
       "14), expected each once"},
      {"a missing velocity", with_header("time,q1,tau1,q2,tau2,qd2"),
       "run.csv:1:22: error: found column 'qd2' without 'qd1', expected qd1, qd2, ... with no gap"},
      {"a word for a number", with_line(20, 7, "0.005,5,off,2.5,7"),
       "run.csv:7:9: error: found 'off', expected a number in column q2"},
      {"a word for time", with_line(20, 7, "12:30:01,5,-5,2.5,7"),
       "run.csv:7:1: error: found '12:30:01', expected a number in column time"},
      {"two signs", with_line(20, 7, "0.005,+-5,-5,2.5,7"),
       "run.csv:7:7: error: found '+-5', expected a number in column q1"},
      {"a cut number in a whole row", with_line(20, 7, "0.005,5,-5,2.5,7e"),
       "run.csv:7:16: error: found '7e', expected a number in column tau2"},
      {"too few columns", with_line(20, 7, "0.005,5,-5,2.5"),
       "run.csv:7:15: error: found 4 columns, expected 5 as in the header (line 1)"},
      {"too many columns", with_line(20, 7, "0.005,5,-5,2.5,7,8,9"),
       "run.csv:7:18: error: found 7 columns, expected 5 as in the header (line 1)"},
      {"a NUL byte", binary,
       "run.csv:3:4: error: found a NUL byte, expected text (a binary file? 'dynid import --list' "
       "says what is in a log, and '--map' reads it)"},
      {"an endless line", joined(plain_lines(10)) + std::string(3 << 20, '1'),
       "run.csv:12:1: error: found a line of more than 1 MB, expected one row a line"},
      {"bad values everywhere", joined(scattered),
       "run.csv:11:16: error: found '1e99' in tau2, the first of 49 bad rows here and there in "
       "500, "
       "expected at most 5 % of the rows to miss a value or to have one beyond 1e9: delete these "
       "rows if the rest is to be used"},
      {"more blocks of bad values than rows", joined(unrecorded),
       "run.csv:101:7: error: found 'nan' in q1, the first of 300 bad rows of 500 in blocks, "
       "expected at most half of the rows to miss a value or to have one beyond 1e9: was this "
       "column "
       "recorded?"},
      {"no run long enough", joined(short_runs),
       "run.csv:41:1: error: found no run of 8 samples among 40 rows of data, expected one or more "
       "(a run ends where time goes back or leaves a gap)"},
  };
}

TEST(RefusedRecordings, SayWhereAndWhatWasExpected) {
  for (const Refusal& refusal : refusals()) {
    EXPECT_EQ(error_of(refusal.text), refusal.message) << refusal.claim;
  }
}

TEST(RefusedRecordings, AreRefusedInChunksToo) {
  for (const Refusal& refusal : refusals()) {
    std::string message = "nothing was thrown";
    try {
      read_in_chunks(refusal.text, 3);
    } catch (const runtime::RecordingError& error) {
      message = error.what();
    }
    EXPECT_EQ(message, refusal.message) << refusal.claim;
  }
}

TEST(RefusedRecordings, OfAnotherNumberOfJoints) {
  runtime::ReadOptions options;
  options.joints = 3;
  EXPECT_EQ(error_of(joined(plain_lines(20)), options),
            "run.csv:1:9: error: found no column 'q3', expected q1 to q3 for 3 joints");
  options.joints = 1;
  EXPECT_EQ(error_of(joined(plain_lines(20)), options),
            "run.csv:1:9: error: found column 'q2', expected q1 to q1 for 1 joints");
}

TEST(RefusedRecordings, ThatCannotBeOpened) {
  try {
    runtime::read_recording("/nowhere/run.csv");
    FAIL() << "nothing was thrown";
  } catch (const runtime::RecordingError& error) {
    EXPECT_STREQ(error.what(),
                 "/nowhere/run.csv: error: cannot open the file: No such file or directory");
  }
  EXPECT_THROW(runtime::read_recording("/"), runtime::RecordingError);
}

}  // namespace
}  // namespace dyngen::test
