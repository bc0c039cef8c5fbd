// SPDX-License-Identifier: MIT
// What is harmless: repaired, and reported in one notice of its kind.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/runtime/recordings/recording_texts.h"

namespace dyngen::test {
namespace {

using Index = Eigen::Index;

struct Defect {
  const char* claim;
  std::string text;
  Index samples;
  std::vector<Index> run_starts;
  std::vector<std::string> notices;
  bool linear = true;  ///< q1 is still 1000 * time
};

std::string replaced(std::string text, char from, char to) {
  std::replace(text.begin(), text.end(), from, to);
  return text;
}

/// 40 samples with lines changed, put in or left out.
class Edit {
 public:
  explicit Edit(int samples = 40) : lines_(plain_lines(samples)) {}
  Edit& line(std::size_t number, const std::string& text) {
    lines_.at(number - 1) = text;
    return *this;
  }
  Edit& insert(std::size_t number, const std::string& text) {
    lines_.insert(lines_.begin() + static_cast<std::ptrdiff_t>(number) - 1, text);
    return *this;
  }
  Edit& erase(std::size_t number, std::size_t count = 1) {
    const auto first = lines_.begin() + static_cast<std::ptrdiff_t>(number) - 1;
    lines_.erase(first, first + static_cast<std::ptrdiff_t>(count));
    return *this;
  }
  Edit& append(const std::string& text) {
    for (std::string& line : lines_) line += text;
    return *this;
  }
  [[nodiscard]] std::string text(const std::string& end = "\n") const {
    return joined(lines_, end);
  }
  [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::vector<std::string> lines_;
};

std::vector<Defect> file_defects() {
  const std::string plain = Edit().text();
  std::string cut = plain;
  cut.resize(cut.size() - 5);
  std::string utf16 = "\xFF\xFE";
  for (const char c : plain) utf16.append(1, c).append(1, '\0');
  std::string german = replaced(replaced(plain, ',', ';'), '.', ',');
  const std::string accepted = "; accepted, and a decimal comma too";
  return {
      {"a byte order mark",
       "\xEF\xBB\xBF" + plain,
       40,
       {0},
       {"run.csv:1:1: warning: found a byte order mark; skipped"}},
      {"UTF-16",
       utf16,
       40,
       {0},
       {"run.csv:1:1: warning: the text is UTF-16; read",
        "run.csv:1:1: warning: found a byte order mark; skipped"}},
      {"UTF-16 without a mark",
       utf16.substr(2),
       40,
       {0},
       {"run.csv:1:1: warning: the text is UTF-16; read"}},
      {"CR LF",
       Edit().text("\r\n"),
       40,
       {0},
       {"run.csv:1:21: warning: lines end with CR LF; accepted"}},
      {"CR alone",
       Edit().text("\r"),
       40,
       {0},
       {"run.csv:1:21: warning: lines end with CR alone; accepted"}},
      {"no end of line at the end", plain.substr(0, plain.size() - 1), 40, {0}, {}},
      {"semicolons and decimal commas",
       german,
       40,
       {0},
       {"run.csv:1:1: warning: columns are separated by semicolons" + accepted}},
      {"semicolons and decimal points",
       replaced(plain, ',', ';'),
       40,
       {0},
       {"run.csv:1:1: warning: columns are separated by semicolons" + accepted}},
      {"tabs",
       replaced(plain, ',', '\t'),
       40,
       {0},
       {"run.csv:1:1: warning: columns are separated by tabs" + accepted}},
      {"blanks",
       replaced(Edit().line(1, " time  q1 q2  tau1 tau2 ").text(), ',', ' '),
       40,
       {0},
       {"run.csv:1:1: warning: columns are separated by blanks" + accepted}},
      {"comments and blank lines",
       Edit().insert(20, "").insert(10, " # later").insert(1, "# made by hand").text(),
       40,
       {0},
       {"run.csv:1:1: warning: found a comment; skipped (2 such in all, the last in line 11)",
        "run.csv:22:1: warning: found a blank line; skipped"}},
      {"a header in a comment",
       Edit().line(1, "# time,q1,q2,tau1,tau2").text(),
       40,
       {0},
       {"run.csv:1:1: warning: found a comment; skipped",
        "run.csv:1:1: warning: the header is a comment; accepted"}},
      {"separators at the end of all lines",
       Edit().append(",").text(),
       40,
       {0},
       {"run.csv:1:22: warning: the header ends with a separator; ignored",
        "run.csv:2:16: warning: rows end with a separator; ignored"}},
      {"separators at the end of rows",
       Edit().append(",").line(1, "time,q1,q2,tau1,tau2").text(),
       40,
       {0},
       {"run.csv:2:16: warning: rows end with a separator; ignored"}},
      {"a truncated last row",
       cut,
       39,
       {0},
       {"run.csv:41: warning: the last row is truncated; left out"}},
      {"a last row cut in a number",
       plain + "0.040,40,-40,20,7e",
       40,
       {0},
       {"run.csv:42: warning: the last row is truncated; left out"}},
  };
}

std::vector<Defect> time_defects() {
  Edit late;
  for (std::size_t i = 21; i <= 41; ++i) {
    std::string text = late.lines()[i - 1];
    late.line(i, "5" + text.substr(1));
  }
  Edit again;
  for (std::size_t i = 2; i <= 41; ++i)
    again.insert(again.lines().size() + 1, again.lines()[i - 1]);
  Edit tail;
  for (std::size_t i = 2; i <= 5; ++i) tail.insert(tail.lines().size() + 1, tail.lines()[i - 1]);
  Edit milliseconds;
  for (std::size_t i = 2; i <= 41; ++i) {
    milliseconds.line(i, std::to_string(i - 2) + ".0" + milliseconds.lines()[i - 1].substr(5));
  }
  return {
      {"a row twice",
       Edit().insert(8, "0.005,5,-5,2.5,7").text(),
       40,
       {0},
       {"run.csv:8: warning: found the row of time 0.005 a second time; left out"}},
      {"a time twice with other values",
       Edit().insert(8, "0.005,5,-5,2.6,7").text(),
       40,
       {0},
       {"run.csv:8: warning: found time 0.005 a second time with other values, expected time to "
        "increase; the row is left out"}},
      {"a sample out of order",
       Edit().insert(12, "0.005,5,-5,2.5,7").text(),
       40,
       {0},
       {"run.csv:12: warning: found time 0.005 after 0.009, expected it to increase steadily; the "
        "row is left out"}},
      {"a wild time",
       Edit().line(12, "9000,10,-10,5,7").text(),
       39,
       {0},
       {"run.csv:12: warning: found time 9000 after 0.009, expected it to increase steadily; the "
        "row is left out"}},
      {"a missing time",
       Edit().line(12, ",10,-10,5,7").text(),
       40,
       {0},
       {"run.csv:12:1: warning: found nothing in time, expected a number of at most 1e9; "
        "interpolated between its neighbours"}},
      {"missing samples",
       Edit().erase(12, 6).text(),
       34,
       {0, 10},
       {"run.csv:12: warning: time leaves a gap: found 0.016 s after 0.009 s; a new run begins "
        "here"}},
      {"a few missing samples are no gap", Edit().erase(12, 4).text(), 36, {0}, {}},
      {"a long pause",
       late.text(),
       40,
       {0, 19},
       {"run.csv:21: warning: time leaves a gap: found 5.019 s after 0.018 s; a new run begins "
        "here"},
       false},
      {"time that starts again",
       again.text(),
       80,
       {0, 40},
       {"run.csv:42: warning: time starts again: found 0 s after 0.039 s; a new run begins here"}},
      {"a short run",
       tail.text(),
       40,
       {0},
       {"run.csv:42: warning: time starts again: found 0 s after 0.039 s; a new run begins here",
        "run.csv:42: warning: found a run of 4 samples, expected 8 or more; left out"}},
      {"few samples in all",
       Edit(5).text(),
       5,
       {0},
       {"run.csv:2: warning: found 5 samples in all; kept, but derivatives need more"}},
      {"milliseconds",
       milliseconds.text(),
       40,
       {0},
       {"run.csv:2: warning: found a usual time step of 1 s, expected time in seconds (not in ms "
        "or "
        "us); taken as seconds"},
       false},
  };
}

std::vector<Defect> value_defects() {
  Edit eleven(60), ten(60);
  for (std::size_t i = 21; i <= 31; ++i) {
    std::string text = eleven.lines()[i - 1];
    const std::string bad = text.substr(0, 6) + "nan" + text.substr(text.find(',', 6));
    eleven.line(i, bad);
    if (i <= 30) ten.line(i, bad);
  }
  const std::string repaired =
      ", expected a number of at most 1e9; interpolated between its neighbours";
  const std::string dropped =
      ", expected a number of at most 1e9; the row is left out (no good row ";
  std::vector<Defect> all;
  for (const std::string word : {"nan", "NaN", "-nan", "inf", "-Inf", "1e99", "-2e9", "1e999", "NA",
                                 "null", "1.#QNAN", "-nan(ind)"}) {
    all.push_back({"one bad value",
                   Edit().line(12, "0.010," + word + ",-10,5,7").text(),
                   40,
                   {0},
                   {"run.csv:12:7: warning: found '" + word + "' in q1" + repaired}});
  }
  const std::vector<Defect> others = {
      {"an empty value",
       Edit().line(12, "0.010,10,-10,,7").text(),
       40,
       {0},
       {"run.csv:12:14: warning: found nothing in tau1" + repaired}},
      {"several bad values",
       Edit().line(12, "0.010,nan,inf,5,7").line(30, "0.028,28,-28,1e99,7").text(),
       40,
       {0},
       {"run.csv:12:7: warning: found 'nan' in q1" + repaired +
        " (2 such in all, the last in line 30)"}},
      {"bad values side by side",
       Edit().line(12, "0.010,nan,-10,5,7").line(13, ",11,nan,5.5,7").text(),
       40,
       {0},
       {"run.csv:12:7: warning: found 'nan' in q1" + repaired +
        " (2 such in all, the last in line 13)"}},
      {"ten bad rows",
       ten.text(),
       60,
       {0},
       {"run.csv:21:7: warning: found 'nan' in q1" + repaired +
        " (10 such in all, the last in line 30)"}},
      {"eleven bad rows",
       eleven.text(),
       49,
       {0, 19},
       {"run.csv:21:7: warning: found 'nan' in q1, and more than 10 bad rows in succession; they "
        "are left out, and a new run begins after them"}},
      {"a bad first row",
       Edit().line(2, "0.000,nan,0,0,7").text(),
       39,
       {0},
       {"run.csv:2:7: warning: found 'nan' in q1" + dropped + "stands before it in its run)"}},
      {"a bad last row",
       Edit().line(41, "0.039,39,nan,19.5,7").text(),
       39,
       {0},
       {"run.csv:41:10: warning: found 'nan' in q2" + dropped + "follows in its run)"}},
  };
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

std::vector<Defect> all_defects() {
  std::vector<Defect> all = file_defects();
  for (const auto& more : {time_defects(), value_defects()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

TEST(RepairedRecordings, AreAsExpectedAndReported) {
  for (const Defect& defect : all_defects()) {
    SCOPED_TRACE(defect.claim);
    const ReadResult result = read_text(defect.text);
    EXPECT_EQ(result.notices, defect.notices);
    EXPECT_EQ(result.recording.samples(), defect.samples);
    EXPECT_EQ(result.recording.run_starts, defect.run_starts);
    if (!defect.linear) continue;
    // time is printed to 1 ms; interpolation rounds a few times
    const auto& recording = result.recording;
    EXPECT_LT((recording.q.col(0) - 1000 * recording.time).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((recording.q.col(1) + recording.q.col(0)).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((recording.tau.col(0) - recording.q.col(0) / 2).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(RepairedRecordings, DoNotDependOnTheSizeOfChunks) {
  for (const Defect& defect : all_defects()) {
    SCOPED_TRACE(defect.claim);
    const ReadResult whole = read_text(defect.text);
    for (const Index rows : {1, 3, 7, 8, 31, 1000}) {
      const ReadResult pieces = read_in_chunks(defect.text, rows);
      EXPECT_TRUE(same(pieces.recording, whole.recording)) << rows;
      EXPECT_EQ(pieces.notices, whole.notices) << rows;
    }
  }
}

TEST(RepairedRecordings, MayHaveManySamplesOfUnevenTime) {
  std::string text = "time,q1,tau1\n";
  for (int k = 0; k < 2000; ++k) {  // steps of 1 ms and 3 ms, and slower after a new start
    const double time = k < 1000 ? 2e-3 * k + (k % 2) * 1e-3 : 0.05 * (k - 1000);
    text += std::to_string(time) + "," + std::to_string(k) + ",1\n";
  }
  const ReadResult result = read_text(text);
  EXPECT_EQ(result.recording.samples(), 2000);
  EXPECT_EQ(result.recording.run_starts, (std::vector<Index>{0, 1000}));
}

/// 40 rows whose torque has six decimals, without the last `off` signs.
std::string six_decimals(std::size_t off) {
  std::string text = "time,q1,tau1\n";
  for (int k = 0; k < 40; ++k) {
    const std::string value = std::to_string(0.5 * k + 0.25);
    text += std::to_string(0.001 * k) + "," + value + "," + value + "\n";
  }
  return text.substr(0, text.size() - 1 - off);
}

TEST(RepairedRecordings, ALastNumberThatIsCutOffIsLeftOut) {
  for (const std::size_t off : {1U, 5U, 6U, 7U}) {
    const ReadResult result = read_text(six_decimals(off));
    EXPECT_EQ(result.recording.samples(), 39) << off;
    ASSERT_EQ(result.notices.size(), 1U) << off;
    EXPECT_EQ(result.notices[0], "run.csv:41: warning: the last row is truncated; left out");
  }
  EXPECT_EQ(read_text(six_decimals(0)).recording.samples(), 40);
  EXPECT_TRUE(read_text(six_decimals(0)).notices.empty());
}

}  // namespace
}  // namespace dyngen::test
