// SPDX-License-Identifier: MIT
#include "runtime/recordings/row_parser.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "runtime/recordings/number_words.h"

namespace dyngen::runtime {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

RowParser::RowParser(const Columns& columns, NoticeLog& log)
    : columns_(&columns),
      log_(&log),
      separator_(columns.separator.character),
      blanks_(columns.separator.character == ' ') {}

bool RowParser::separates(char c) const { return blanks_ ? is_blank(c) : c == separator_; }

const char* RowParser::field_end(const Cursor& cursor) const {
  const char* at = cursor.at;
  if (at != cursor.end && (*at == '"' || *at == '\'')) {
    for (const char* close = at + 1; close != cursor.end; ++close) {
      if (*close == *at) {
        at = close;
        break;
      }
    }
  }
  while (at != cursor.end && !separates(*at)) ++at;
  return at;
}

/// The slow way, for what is not a plain number.
RowParser::Word RowParser::read_word(std::string_view text, std::string_view line, bool is_time,
                                     double& value) {
  value = kMissing;
  scratch_.assign(text);
  for (char& c : scratch_) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (means_missing(scratch_)) return Word::kBad;
  const NumberStyle style = use_decimal_point(scratch_, line);
  if (style == NumberStyle::kAmbiguous) return Word::kAmbiguous;
  if (style == NumberStyle::kNone) return Word::kNone;
  std::string_view word = scratch_;
  const bool negative = word.front() == '-';
  if (negative || word.front() == '+') word.remove_prefix(1);
  if (word.empty() || word.front() == '-' || word.front() == '+') return Word::kNone;
  if (means_missing(word)) return Word::kBad;
  double magnitude = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), magnitude);
  if (error == std::errc::invalid_argument || stop != word.data() + word.size()) {
    return Word::kNone;
  }
  if (error == std::errc::result_out_of_range) {
    if (word.find("e-") == word.npos) return Word::kBad;
    magnitude = 0;
  }
  if (!(magnitude <= (is_time ? kWildTime : kWildValue))) return Word::kBad;
  value = negative ? -magnitude : magnitude;
  return Word::kNumber;
}

void RowParser::mark_bad(RowInfo& info, std::size_t field, std::size_t column,
                         std::string_view text) const {
  if (info.bad()) return;
  info.bad_column = column;
  info.bad_word = text.empty() ? fmt::format("nothing in {}", columns_->names[field])
                               : fmt::format("{} in {}", quoted(text), columns_->names[field]);
}

void RowParser::note_segment(std::string_view text) {
  if (text.empty() || (has_segment_ && text == segment_text_)) return;
  if (segments_come_again_) {
    const auto known = segments_.find(text);
    segment_ = known != segments_.end() ? known->second
                                        : segments_.emplace(text, segments_.size()).first->second;
    segment_text_.assign(text);
    has_segment_ = true;
    return;
  }
  if (has_segment_) ++segment_;
  has_segment_ = true;
  segment_text_.assign(text);
}

RowParser::Outcome RowParser::short_row(const Line& line, std::size_t column,
                                        const std::string& message) {
  too_short_ = recording_error(log_->file(), line.number, column, message);
  return Outcome::kTooShort;
}

/// Reads the value of a field that is used. @return  where the field ends
const char* RowParser::read_value(const Line& line, const Cursor& cursor, std::size_t field,
                                  double& value, RowInfo& info) {
  const bool is_time = columns_->target[field] == 0;
  const double limit = is_time ? kWildTime : kWildValue;
  const auto [after, error] = std::from_chars(cursor.at, cursor.end, value);
  if (error == std::errc() && (after == cursor.end || separates(*after)) &&
      std::abs(value) <= limit) {
    return after;
  }
  const char* stop = field_end(cursor);
  const auto column = static_cast<std::size_t>(cursor.at - cursor.begin) + 1;
  std::string_view text = trimmed({cursor.at, static_cast<std::size_t>(stop - cursor.at)});
  if (text.size() >= 2 && text.front() == text.back() &&
      (text.front() == '"' || text.front() == '\'')) {
    text = trimmed(text.substr(1, text.size() - 2));
  }
  switch (read_word(text, line.text, is_time, value)) {
    case Word::kNumber:
      break;
    case Word::kBad:
      // a temperature that is missing makes no row bad: repair_temperatures() fills it
      if (columns_->quantities[field] == ColumnQuantity::kTemperature) {
        value = std::numeric_limits<double>::quiet_NaN();
      } else {
        mark_bad(info, field, column, text);
      }
      break;
    case Word::kAmbiguous:
      throw recording_error(
          log_->file(), line.number, column,
          fmt::format("found {} in column {} beside numbers with a decimal point, expected one "
                      "decimal sign (does the comma part thousands?)",
                      quoted(text), columns_->names[field]));
    case Word::kNone: {
      const std::string message = fmt::format("found {}, expected a number in column {}",
                                              quoted(text), columns_->names[field]);
      if (stop != cursor.end || line.terminated) {
        throw recording_error(log_->file(), line.number, column, message);
      }
      cut_word_ = true;
      short_row(line, column, message);
    }
  }
  return stop;
}

/// Counts what is left of a line after the fields that were read.
RowParser::Outcome RowParser::finish(const Line& line, const Cursor& cursor, std::size_t fields,
                                     bool ended) {
  const std::size_t expected = columns_->target.size();
  const auto place = static_cast<std::size_t>(cursor.at - cursor.begin);
  if (fields < expected) {
    return short_row(line, line.text.size() + 1,
                     fmt::format("found {} columns, expected {} as in the header (line {})", fields,
                                 expected, columns_->header_line));
  }
  if (ended) return Outcome::kRow;
  const std::string_view rest = line.text.substr(place);
  if (trimmed(rest).empty()) {
    if (!blanks_) {
      log_->add_once("trailing separator", line.number, place,
                     "rows end with a separator; ignored");
    }
    return Outcome::kRow;
  }
  const std::size_t found = fields + split_fields(rest, columns_->separator).size();
  // Of "0,001,1,5,2,25" nobody can tell which comma is which.
  const bool decimal_commas = columns_->separator.character == ',' && found <= 2 * expected &&
                              found + 2 >= 2 * expected && line.text.find('.') == line.text.npos;
  throw recording_error(log_->file(), line.number, place + 1,
                        fmt::format("found {} columns, expected {} as in the header (line {}){}",
                                    found, expected, columns_->header_line,
                                    decimal_commas ? "; numbers with a decimal comma need quotes, "
                                                     "or semicolons between columns"
                                                   : ""));
}

RowParser::Outcome RowParser::parse(const Line& line, RowQueue& rows) {
  double* values = rows.values(rows.size() - 1);
  RowInfo& info = rows.info(rows.size() - 1);
  info.line = line.number;
  info.bad_column = 0;
  info.starts_run = false;

  const char* begin = line.text.data();
  Cursor cursor{begin, begin, begin + line.text.size()};
  const std::size_t expected = columns_->target.size();
  bool ended = false;
  cut_word_ = false;
  std::size_t field = 0;
  for (; field < expected && !ended; ++field) {
    while (cursor.at != cursor.end && is_blank(*cursor.at) &&
           (blanks_ || *cursor.at != separator_)) {
      ++cursor.at;
    }
    if (blanks_ && cursor.at == cursor.end) break;
    const int target = columns_->target[field];
    const char* stop = nullptr;
    if (target >= 0) {
      double value = 0;
      stop = read_value(line, cursor, field, value, info);
      if (cut_word_) return Outcome::kTooShort;
      values[target] = columns_->converts ? columns_->conversions[field](value) : value;
    } else {
      stop = field_end(cursor);
      if (target == Columns::kSegment) {
        note_segment(trimmed({cursor.at, static_cast<std::size_t>(stop - cursor.at)}));
      }
    }
    ended = stop == cursor.end;
    if (ended && target >= 0 && field + 1 == expected) {
      const std::string_view word(cursor.at, static_cast<std::size_t>(stop - cursor.at));
      if (!line.terminated && last_numbers_.is_cut(word)) {
        return short_row(line, static_cast<std::size_t>(cursor.at - begin) + 1,
                         fmt::format("found {} at the end of the file, expected as many digits as "
                                     "in the rows before",
                                     quoted(word)));
      }
      last_numbers_.add(word);
    }
    cursor.at = ended ? stop : stop + 1;
  }
  info.segment = segment_;
  return finish(line, cursor, field, ended);
}

}  // namespace dyngen::runtime
