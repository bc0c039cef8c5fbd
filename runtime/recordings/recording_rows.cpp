// SPDX-License-Identifier: MIT
#include "runtime/recordings/recording_rows.h"

#include <fmt/format.h>

#include <charconv>
#include <utility>
#include <vector>

namespace dyngen::runtime {
namespace {

/// A comment without what makes it one.
std::string_view without_marks(std::string_view comment) {
  const std::size_t begin = comment.find_first_not_of("# \t");
  return begin == comment.npos ? std::string_view() : comment.substr(begin);
}

bool reads_as_number(std::string_view text) {
  std::string word(text);
  if (!word.empty() && word[0] == '+') word.erase(0, 1);
  for (char& c : word) {
    if (c == ',') c = '.';
  }
  double value = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && stop == word.data() + word.size();
}

/// "q1,q2,q3" or "q1,...,q7", each after the separator.
std::string numbered_names(std::string_view word, std::size_t count, char separator) {
  constexpr std::size_t kWritten = 3;
  std::string names;
  for (std::size_t i = 1; i <= count; ++i) {
    if (count > kWritten && i == 2) names += fmt::format("{}...", separator);
    if (count > kWritten && i > 1 && i < count) continue;
    names += fmt::format("{}{}{}", separator, word, i);
  }
  return names;
}

}  // namespace

RecordingRows::RecordingRows(ByteSource source, const ExpectedColumns& expected, NoticeLog& log)
    : log_(&log), lines_(std::move(source), log), columns_(find_header(expected)) {
  // A row of units changes the columns, so it is read before the first row of data.
  units_may_come_ = true;
  if (!comment_after_.empty()) read_unit_row(comment_after_, comment_after_line_, columns_, log);
  if (next_line()) held_back_ = !read_unit_row(line_.text, line_.number, columns_, log);
  units_may_come_ = false;
  parser_.emplace(columns_, log);
}

bool RecordingRows::next(RowQueue& rows) {
  while (next_line()) {
    if (last_short_) throw *last_short_;
    rows.add();
    if (parser_->parse(line_, rows) == RowParser::Outcome::kRow) return true;
    rows.pop_back();
    last_short_ = parser_->too_short();
    last_short_line_ = line_.number;
  }
  if (last_short_) {
    log_->add_once("truncated", last_short_line_, 0, "the last row is truncated; left out");
    last_short_.reset();
  }
  return false;
}

bool RecordingRows::next_line() {
  if (held_back_) {
    held_back_ = false;
    return true;
  }
  while (lines_.next(line_)) {
    const std::string_view text = trimmed(line_.text);
    if (text.empty()) {
      log_->add("blank", line_.number, 1, "found a blank line; skipped");
    } else if (text.front() == '#') {
      const std::string_view words = without_marks(text);
      if (units_may_come_ && read_unit_row(words, line_.number, columns_, *log_)) continue;
      log_->add("comment", line_.number, 1, "found a comment; skipped");
      keep_comment(words);
    } else {
      return true;
    }
  }
  return false;
}

/// Some programs write the header as a comment, and units in the next one.
void RecordingRows::keep_comment(std::string_view text) {
  constexpr std::size_t kLongest = 1 << 16;
  if (header_found_ || text.size() > kLongest) return;
  if (looks_like_header(text)) {
    comment_.assign(text);
    comment_line_ = line_.number;
    comment_after_.clear();
  } else if (!comment_.empty() && comment_after_.empty()) {
    comment_after_.assign(text);
    comment_after_line_ = line_.number;
  }
}

/// The first line is numbers, and no comment names them.
void RecordingRows::refuse_numbers(const ExpectedColumns& expected, char separator) const {
  const std::size_t count = split_fields(trimmed(line_.text), {separator}).size();
  const std::string begin = fmt::format(
      "found numbers in the first line, expected a header: put a line before it that "
      "names its {} columns",
      count);
  const std::size_t groups = expected.torque ? 2 : 1;
  const std::size_t given = expected.joints > 0 ? static_cast<std::size_t>(expected.joints) : 0;
  const std::size_t joints = given != 0 ? given : (count - 1) / groups;
  std::string advice = ", 'time', 'q1', ... and 'tau1', ... among them";
  if (joints > 0) {
    const auto names = [&](std::string_view word) {
      return numbered_names(word, joints, separator);
    };
    const std::size_t named = 1 + groups * joints;
    std::string example = "time" + names("q") + (expected.torque ? names("tau") : "");
    if (named < count) example += numbered_names("x", count - named, separator);
    advice = fmt::format(", such as '{}' if that is their order (names of other columns are free)",
                         example);
  }
  throw recording_error(log_->file(), line_.number, 1, begin + advice);
}

Columns RecordingRows::find_header(const ExpectedColumns& expected) {
  const auto first_line = [&] {
    if (next_line()) return;
    throw recording_error(log_->file(), line_.number, 1,
                          line_.number == 0
                              ? "found an empty file, expected a recording"
                              : fmt::format("found no header, expected 'time,q1,...{}'",
                                            expected.torque ? ",tau1,..." : ""));
  };
  first_line();
  const char told = told_separator(line_.text);
  if (told != '\0') {
    log_->add_once("told separator", line_.number, 1,
                   fmt::format("found a line that says that columns are separated by {}; accepted",
                               quoted({&told, 1})));
    first_line();
  }
  header_found_ = true;
  const std::string_view text = trimmed(line_.text);
  const char separator = told != '\0' ? told : separator_of(text);
  const std::vector<Field> fields = split_fields(text, {separator});
  const bool numbers = !fields.empty() && reads_as_number(fields.front().text);
  constexpr std::string_view kNumberBegins = "+-.0123456789";
  if (!comment_.empty() && (numbers || kNumberBegins.find(text.front()) != text.npos)) {
    log_->add_once("comment header", comment_line_, 1, "the header is a comment; accepted");
    held_back_ = true;
    return read_header(comment_, comment_line_, told, expected.joints, expected.torque, *log_);
  }
  comment_after_.clear();
  if (numbers) refuse_numbers(expected, separator);
  return read_header(line_.text, line_.number, told, expected.joints, expected.torque, *log_);
}

}  // namespace dyngen::runtime
