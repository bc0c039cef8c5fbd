// SPDX-License-Identifier: MIT
#include "runtime/logs/text_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "runtime/logs/log_error.h"
#include "runtime/logs/log_words.h"
#include "runtime/logs/quoted_lines.h"
#include "runtime/logs/row_rounds.h"
#include "runtime/logs/text_layout.h"
#include "runtime/logs/time_words.h"
#include "runtime/recordings/columns.h"
#include "runtime/recordings/cut_number.h"

namespace dyngen::runtime {
namespace {

/// Lines from which the layout is found.
constexpr std::size_t kSampleLines = 500;
constexpr std::size_t kSampleBytes = 1 << 20;
constexpr std::size_t kMostTextNotices = 20;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// The first value of a field whose values are counted from it.
struct FieldBase {
  bool known = false;
  std::int64_t first = 0;
  std::int64_t last = 0;     ///< the value before, with the days that were added
  std::int64_t days_ns = 0;  ///< added since midnight was passed
};

class TextLog final : public RawLog {
 public:
  TextLog(ByteSource source, const std::string& name, const LogTextSettings& settings);

  [[nodiscard]] const std::vector<LogTable>& tables() const override { return layout_.tables; }
  bool next(LogRows& rows, std::size_t at_most) override;
  [[nodiscard]] std::string place_word() const override { return "line"; }
  [[nodiscard]] std::vector<std::string> notices() const override;
  [[nodiscard]] std::optional<ColumnOrigin> origin(std::size_t table,
                                                   std::size_t column) const override;
  [[nodiscard]] std::string constant_word(std::size_t table, std::size_t column) const override;
  [[nodiscard]] double fraction_read() const override;

 private:
  void read_sample();
  bool next_line();
  bool next_row();
  bool read_fields();
  bool is_cut_within();
  double read_field(std::size_t field, std::string_view text, std::size_t column);
  double read_counted(std::size_t field, std::string_view text, bool& understood);
  double no_value(std::size_t field, std::string_view text, std::size_t column);
  void refuse_rest(std::size_t place, std::size_t fields) const;
  [[nodiscard]] bool separates(char c) const;
  bool read_plain(const char* at, const char* end, double& value, const char*& after) const;

  NoticeLog log_;
  QuotedLines lines_;
  std::vector<SampleLine> sample_;
  std::size_t replayed_ = 0;  ///< lines of the sample that were handed out
  bool whole_ = false;        ///< the sample is the whole file
  Line line_;
  TextLayout layout_;
  std::vector<FieldBase> bases_;
  RowRounds rounds_;
  std::vector<double> values_;  ///< of the row that is read
  std::string scratch_;
  std::optional<RecordingError> short_row_;  ///< an error, unless the file ends there
  std::size_t short_line_ = 0;
  CutNumber last_numbers_;      ///< at the ends of the rows before
  std::string_view last_word_;  ///< of the row that is read, if it ends there; no text
  bool ends_file_ = false;      ///< the word that is read
  bool cut_word_ = false;       ///< that word is no number
  bool at_end_ = false;
};

std::vector<std::size_t> widths_of(const std::vector<LogTable>& tables) {
  std::vector<std::size_t> widths;
  for (const LogTable& table : tables) widths.push_back(table.columns.size());
  return widths;
}

TextLog::TextLog(ByteSource source, const std::string& name, const LogTextSettings& settings)
    : log_(name, kMostTextNotices), lines_(std::move(source), log_), rounds_({}) {
  read_sample();
  layout_ = find_layout(sample_, whole_, settings, log_);
  replayed_ = layout_.first_row;
  bases_.resize(layout_.fields.size());
  values_.resize(layout_.fields.size());
  rounds_ = RowRounds(widths_of(layout_.tables));
}

void TextLog::read_sample() {
  std::size_t bytes = 0;
  Line line;
  while (sample_.size() < kSampleLines && bytes < kSampleBytes) {
    if (!lines_.next(line)) {
      whole_ = true;
      return;
    }
    if (trimmed(line.text).empty()) continue;
    sample_.push_back({std::string(line.text), line.number, line.terminated});
    bytes += line.text.size();
  }
}

bool TextLog::next_line() {
  if (replayed_ < sample_.size()) {
    const SampleLine& line = sample_[replayed_++];
    line_ = {line.text, line.number, line.terminated};
    return true;
  }
  if (!sample_.empty() && replayed_ == sample_.size()) {  // line_ may still be one of them
    sample_.clear();
    replayed_ = 0;
  }
  while (!whole_ && lines_.next(line_)) {
    if (!trimmed(line_.text).empty()) return true;
  }
  return false;
}

/// A word that is no number.
double TextLog::no_value(std::size_t field, std::string_view text, std::size_t column) {
  if (ends_file_) {
    cut_word_ = true;
    return kNothing;
  }
  const TextField& place = layout_.fields[field];
  const std::string& name = layout_.tables[place.table].columns[place.column];
  if (kind_of_word(text) == WordKind::kNumber) {
    throw recording_error(
        log_.file(), line_.number, column,
        fmt::format("found {} in {}, expected a number with '{}' before decimals{}",
                    in_quotes(text), in_quotes(name), layout_.decimal,
                    layout_.decimal_word.empty()
                        ? std::string()
                        : fmt::format(", as in {}", in_quotes(layout_.decimal_word))));
  }
  log_.add(fmt::format("word {}", field), line_.number, column,
           fmt::format("found {} in {}, expected a number; it has no value", in_quotes(text),
                       in_quotes(name)));
  return kNothing;
}

/// Values that a double would not hold.
double TextLog::read_counted(std::size_t field, std::string_view text, bool& understood) {
  const FieldKind kind = layout_.fields[field].kind;
  FieldBase& base = bases_[field];
  std::int64_t count = 0;
  double scale = 1;
  if (kind == FieldKind::kInstant || kind == FieldKind::kTimeOfDay) {
    const auto time = read_time_word(text);
    const bool of_day = kind == FieldKind::kTimeOfDay;
    understood = time && (time->kind == TimeWordKind::kTimeOfDay) == of_day;
    if (!understood) return kNothing;
    count = time->nanoseconds + base.days_ns;
    // a clock that falls by more than half a day has passed midnight
    if (of_day && base.known && base.last - count > kNanosecondsPerDay / 2) {
      base.days_ns += kNanosecondsPerDay;
      count += kNanosecondsPerDay;
    }
    scale = 1e9;
  } else {
    const auto number = whole_number(text, layout_.decimal);
    const bool fits = number && (number->whole || kind == FieldKind::kNanoCount);
    if (!fits) {
      const auto value = value_of_word(text, layout_.decimal, scratch_);
      understood = value.has_value();
      if (!understood || !base.known) return kNothing;
      const double unit = kind == FieldKind::kNanoCount ? 1e9 : 1;
      return *value - static_cast<double>(base.first) / unit;
    }
    count = number->count;
    if (kind == FieldKind::kNanoCount) {
      scale = 1e9;
      constexpr std::int64_t kMost =
          std::numeric_limits<std::int64_t>::max() / kNanosecondsPerSecond;
      understood = !number->whole || (count < kMost && count > -kMost);
      if (!understood) return kNothing;
      if (number->whole) count *= kNanosecondsPerSecond;
    }
  }
  if (!base.known) base.first = count;
  base.known = true;
  base.last = count;
  std::int64_t difference = 0;
  understood = !__builtin_sub_overflow(count, base.first, &difference);
  return understood ? static_cast<double>(difference) / scale : kNothing;
}

double TextLog::read_field(std::size_t field, std::string_view text, std::size_t column) {
  const FieldKind kind = layout_.fields[field].kind;
  if (kind == FieldKind::kText) return kNothing;
  if (kind != FieldKind::kNumber) {
    bool understood = true;
    const double counted = read_counted(field, text, understood);
    if (understood || kind_of_word(text) == WordKind::kMissing) return counted;
    return no_value(field, text, column);
  }
  const auto value = value_of_word(text, layout_.decimal, scratch_);
  return value ? *value : no_value(field, text, column);
}

void TextLog::refuse_rest(std::size_t place, std::size_t fields) const {
  const std::string_view rest = line_.text.substr(place);
  const std::size_t found = fields + split_fields(rest, {layout_.separator}).size();
  const bool commas = layout_.separator == ',' && line_.text.find('.') == line_.text.npos;
  throw recording_error(
      log_.file(), line_.number, place + 1,
      fmt::format("found {} values, expected {} as in the rows before{}", found, fields,
                  commas ? "; numbers with a decimal comma need quotes, or semicolons between "
                           "columns"
                         : ""));
}

bool TextLog::separates(char c) const {
  return layout_.separator == ' ' ? is_blank(c) : c == layout_.separator;
}

/// The fast way, for a finite number without signs that part thousands.
bool TextLog::read_plain(const char* at, const char* end, double& value, const char*& after) const {
  std::from_chars_result result{at, std::errc()};
  if (layout_.decimal == '.') {
    result = std::from_chars(at, end, value);
    after = result.ptr;
  } else {
    std::array<char, 32> word;
    std::size_t size = 0;
    while (at + size != end && size < word.size() && !separates(at[size])) {
      if (at[size] == '.') return false;
      word[size] = at[size] == ',' ? '.' : at[size];
      ++size;
    }
    result = std::from_chars(word.data(), word.data() + size, value);
    if (result.ptr != word.data() + size) return false;
    after = at + size;
  }
  const bool finite = result.ec == std::errc() && std::isfinite(value);
  return finite && (after == end || separates(*after));
}

/// Cuts line_ into values_; false if it is too short.
bool TextLog::read_fields() {
  const char separator = layout_.separator;
  const bool blanks = separator == ' ';
  const char* const begin = line_.text.data();
  const char* const end = begin + line_.text.size();
  const char* at = begin;
  const std::size_t expected = layout_.fields.size();
  std::size_t field = 0;
  bool ended = false;
  last_word_ = {};
  ends_file_ = cut_word_ = false;
  for (; field < expected && !ended; ++field) {
    while (at != end && is_blank(*at) && (blanks || *at != separator)) ++at;
    if (blanks && at == end) break;
    const char* after = at;
    if (layout_.fields[field].kind == FieldKind::kNumber &&
        read_plain(at, end, values_[field], after)) {
      ended = after == end;
      if (ended) last_word_ = {at, static_cast<std::size_t>(after - at)};
      at = ended ? after : after + 1;
      continue;
    }
    const char* stop = at;
    const bool in_quotes = at != end && (*at == '"' || *at == '\'');
    if (in_quotes) {
      const char* close = std::find(at + 1, end, *at);
      if (close != end) stop = close;
    }
    while (stop != end && !separates(*stop)) ++stop;
    std::string_view text = trimmed({at, static_cast<std::size_t>(stop - at)});
    if (in_quotes && text.size() >= 2 && text.back() == text.front()) {
      text = trimmed(text.substr(1, text.size() - 2));
    }
    ended = stop == end;
    ends_file_ = ended && !line_.terminated;
    values_[field] = read_field(field, text, static_cast<std::size_t>(at - begin) + 1);
    if (ended && layout_.fields[field].kind != FieldKind::kText) last_word_ = text;
    at = ended ? stop : stop + 1;
  }
  if (field < expected) {
    // signals that have ended leave their fields out
    const bool has_ends = layout_.tables.size() > 1 && field > 0;
    std::fill(values_.begin() + static_cast<std::ptrdiff_t>(field), values_.end(), kNothing);
    if (has_ends && line_.terminated) return true;
    short_row_ = recording_error(
        log_.file(), line_.number, line_.text.size() + 1,
        fmt::format("found {} values, expected {} as in the rows before", field, expected));
    short_line_ = line_.number;
    return false;
  }
  if (ended) return true;
  const auto place = static_cast<std::size_t>(at - begin);
  const std::string_view rest = line_.text.substr(place);
  const auto is_rest = [&](char c) { return is_blank(c) || c == separator; };
  if (!std::all_of(rest.begin(), rest.end(), is_rest)) refuse_rest(place, expected);
  return true;
}

/// Whether the file ends within the last number of the row; else the number is remembered.
bool TextLog::is_cut_within() {
  if (last_word_.empty()) return false;
  if (line_.terminated || (!cut_word_ && !last_numbers_.is_cut(last_word_))) {
    last_numbers_.add(last_word_);
    return false;
  }
  log_.add_once(
      "cut off", line_.number, line_.text.size(),
      fmt::format("the last row is cut off within a number ({}); left out", in_quotes(last_word_)));
  return true;
}

/// Reads one line into rows; false at the end of the file.
bool TextLog::next_row() {
  while (next_line()) {
    if (is_comment(line_.text)) {
      log_.add("comment", line_.number, 1, "found a comment among the rows; skipped");
      continue;
    }
    if (layout_.header_line != 0 && line_.text == layout_.header) {
      log_.add("header again", line_.number, 1, "found the names again; skipped");
      continue;
    }
    if (short_row_) throw *short_row_;
    if (!read_fields()) continue;
    if (is_cut_within()) continue;
    const bool one_table = layout_.tables.size() == 1;
    for (std::size_t begin = 0; begin < values_.size();) {
      const std::size_t table = layout_.fields[begin].table;
      const std::size_t end = begin + layout_.tables[table].columns.size();
      const auto first = values_.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto last = values_.begin() + static_cast<std::ptrdiff_t>(end);
      const bool some = std::any_of(first, last, [](double value) { return value == value; });
      if (some || one_table) std::copy(first, last, rounds_.add(table, line_.number));
      begin = end;
    }
    return true;
  }
  if (short_row_) {
    log_.add_once("cut off", short_line_, 0, "the last row is cut off; left out");
    short_row_.reset();
  }
  return false;
}

bool TextLog::next(LogRows& rows, std::size_t at_most) {
  const std::size_t wanted = std::max<std::size_t>(at_most, 1);
  if (rounds_.waiting() == 0) {
    try {
      while (!at_end_ && rounds_.waiting() < wanted) at_end_ = !next_row();
    } catch (const RecordingError& error) {
      throw LogError(error.what());
    }
  }
  if (rounds_.waiting() == 0) return false;
  rounds_.take(rows, wanted);
  return true;
}

std::vector<std::string> TextLog::notices() const {
  std::vector<std::string> texts;
  for (const Notice& notice : log_.notices()) texts.push_back(notice.text());
  return texts;
}

std::optional<ColumnOrigin> TextLog::origin(std::size_t table, std::size_t column) const {
  for (std::size_t i = 0; i < layout_.fields.size(); ++i) {
    const TextField& field = layout_.fields[i];
    if (field.table != table || field.column != column || !bases_[i].known) continue;
    return ColumnOrigin{bases_[i].first,
                        field.kind == FieldKind::kWhole ? 1 : kNanosecondsPerSecond};
  }
  return std::nullopt;
}

std::string TextLog::constant_word(std::size_t table, std::size_t column) const {
  const auto found = std::find_if(
      layout_.fields.begin(), layout_.fields.end(),
      [&](const TextField& field) { return field.table == table && field.column == column; });
  return found == layout_.fields.end() ? std::string() : found->word;
}

double TextLog::fraction_read() const { return at_end_ ? 1 : lines_.fraction_read(); }

}  // namespace

std::unique_ptr<RawLog> open_text_log(ByteSource source, const std::string& name,
                                      const LogTextSettings& settings) {
  try {
    return std::make_unique<TextLog>(std::move(source), name, settings);
  } catch (const RecordingError& error) {
    throw LogError(error.what());
  }
}

}  // namespace dyngen::runtime
