// SPDX-License-Identifier: MIT
#include "runtime/logs/text_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "runtime/logs/log_error.h"
#include "runtime/logs/log_words.h"
#include "runtime/logs/text_header.h"
#include "runtime/logs/text_rows.h"
#include "runtime/logs/time_words.h"
#include "runtime/recordings/columns.h"
#include "runtime/recordings/text_encoding.h"

namespace dyngen::runtime {
namespace {

constexpr std::size_t kMostFields = 20'000;

/// "semicolons", "tabs", ...
std::string separator_name(char separator) {
  switch (separator) {
    case ';':
      return "semicolons";
    case ',':
      return "commas";
    case '\t':
      return "tabs";
    case ' ':
      return "blanks";
    default:
      return fmt::format("'{}'", separator);
  }
}

class LayoutFinder {
 public:
  LayoutFinder(const std::vector<SampleLine>& sample, bool whole, const LogTextSettings& settings,
               NoticeLog& log)
      : sample_(&sample), whole_(whole), settings_(&settings), log_(&log) {}

  TextLayout find();

 private:
  void find_rows();
  void find_decimal();
  void find_kinds();
  [[nodiscard]] FieldKind kind_of_field(std::size_t field) const;
  [[nodiscard]] std::string word_of(std::size_t field) const;
  TextHeader given_columns() const;
  void place_fields(const TextHeader& header);
  void tell(const TextHeader& header) const;
  [[nodiscard]] const SampleLine& line_of_row(std::size_t row) const {
    return (*sample_)[rows_.rows[row]];
  }

  const std::vector<SampleLine>* sample_;
  bool whole_;
  const LogTextSettings* settings_;
  NoticeLog* log_;
  std::size_t begin_ = 0;  ///< the first line that may be a header
  SampleRows rows_;
  std::vector<std::vector<std::string_view>> words_;  ///< of the rows
  TextLayout layout_;
};

void LayoutFinder::find_rows() {
  std::optional<char> separator = settings_->separator;
  while (begin_ < sample_->size() && (*sample_)[begin_].number <= settings_->skip_lines) ++begin_;
  if (begin_ < sample_->size()) {
    const char told = told_separator((*sample_)[begin_].text);
    if (told != '\0') {
      ++begin_;
      if (!separator) separator = told;
    }
  }
  const std::vector<SampleLine> lines(
      sample_->begin() + static_cast<std::ptrdiff_t>(std::min(begin_, sample_->size())),
      sample_->end());
  if (lines.empty()) {
    throw recording_error(log_->file(), sample_->empty() ? 0 : sample_->back().number, 1,
                          "found no lines to read, expected rows of numbers");
  }
  std::optional<SampleRows> found = best_rows(lines, separator);
  if (!found) {
    throw recording_error(
        log_->file(), lines.front().number, 1,
        fmt::format("found no row of numbers in {} lines{}, expected a table; first words: {}",
                    lines.size(),
                    whole_ ? "" : " (say how many lines to skip, if rows begin later)",
                    in_quotes(trimmed(lines.front().text))));
  }
  rows_ = std::move(*found);
  for (std::size_t& row : rows_.rows) row += begin_;
  if (rows_.fields > kMostFields) {
    throw recording_error(
        log_->file(), line_of_row(0).number, 1,
        fmt::format("found a row of {} values, expected {} at most", rows_.fields, kMostFields));
  }
  for (std::size_t row = 0; row < rows_.rows.size(); ++row) {
    words_.push_back(fields_of(line_of_row(row).text, rows_.separator, rows_.fields));
  }
  layout_.separator = rows_.separator;
  layout_.first_row = rows_.rows.front();
}

void LayoutFinder::find_decimal() {
  DecimalEvidence evidence;
  std::size_t point_line = 0, comma_line = 0;
  for (std::size_t row = 0; row < words_.size(); ++row) {
    for (std::size_t i = 0; i < words_[row].size(); ++i) {
      if (rows_.column_kinds[i] != WordKind::kNumber) continue;
      evidence.add(words_[row][i]);
    }
    if (point_line == 0 && !evidence.point.empty()) point_line = line_of_row(row).number;
    if (comma_line == 0 && !evidence.comma.empty()) comma_line = line_of_row(row).number;
  }
  if (settings_->decimal) {
    layout_.decimal = *settings_->decimal;
    return;
  }
  if (!evidence.point.empty() && !evidence.comma.empty()) {
    throw recording_error(
        log_->file(), std::max(point_line, comma_line), 1,
        fmt::format("found {} (line {}) and {} (line {}), expected one decimal sign in the file",
                    in_quotes(evidence.point), point_line, in_quotes(evidence.comma), comma_line));
  }
  layout_.decimal_word = !evidence.point.empty()   ? evidence.point
                         : !evidence.comma.empty() ? evidence.comma
                                                   : evidence.either;
  if (!evidence.point.empty()) return;
  if (!evidence.comma.empty()) {
    layout_.decimal = ',';
    log_->add_once(
        "decimal", comma_line, 1,
        fmt::format("numbers have a decimal comma ({}); read", in_quotes(evidence.comma)));
  } else if (evidence.either.find(',') != evidence.either.npos) {
    layout_.decimal = ',';
    log_->add_once("decimal", 0, 0,
                   fmt::format("{} is read with a decimal comma; say that the decimal sign is '.' "
                               "if commas part thousands",
                               in_quotes(evidence.either)));
  }
}

FieldKind LayoutFinder::kind_of_field(std::size_t field) const {
  switch (rows_.column_kinds[field]) {
    case WordKind::kText:
      return FieldKind::kText;
    case WordKind::kTime:
      for (const auto& words : words_) {
        const auto time = field < words.size() ? read_time_word(words[field]) : std::nullopt;
        if (!time) continue;
        return time->kind == TimeWordKind::kInstant ? FieldKind::kInstant : FieldKind::kTimeOfDay;
      }
      return FieldKind::kText;
    case WordKind::kMissing:
    case WordKind::kNumber:
      break;
  }
  bool long_words = false, fractions = false;
  for (const auto& words : words_) {
    if (field >= words.size() || !needs_more_than_double(words[field])) continue;
    const auto number = whole_number(words[field], layout_.decimal);
    if (!number) return FieldKind::kNumber;
    long_words = true;
    fractions = fractions || !number->whole;
  }
  if (!long_words) return FieldKind::kNumber;
  return fractions ? FieldKind::kNanoCount : FieldKind::kWhole;
}

/// The word that all rows have in a field.
std::string LayoutFinder::word_of(std::size_t field) const {
  std::string_view word;
  for (const auto& words : words_) {
    if (field >= words.size() || (!word.empty() && words[field] != word)) return {};
    word = words[field];
  }
  if (word.size() >= 2 && word.front() == '"' && word.back() == '"') {
    word = word.substr(1, word.size() - 2);
  }
  return as_utf8(trimmed(word));
}

void LayoutFinder::find_kinds() {
  for (std::size_t i = 0; i < rows_.fields; ++i) {
    layout_.fields.push_back({0, i, kind_of_field(i)});
    if (layout_.fields.back().kind == FieldKind::kText) layout_.fields.back().word = word_of(i);
  }
}

TextHeader LayoutFinder::given_columns() const {
  TextHeader header;
  header.names = *settings_->columns;
  const bool empty_end =
      header.names.size() + 1 == rows_.fields && rows_.column_kinds.back() == WordKind::kMissing;
  if (header.names.size() != rows_.fields && !empty_end) {
    throw recording_error(log_->file(), line_of_row(0).number, 1,
                          fmt::format("found {} values in a row, expected the {} columns that "
                                      "were named",
                                      rows_.fields, header.names.size()));
  }
  if (empty_end) header.names.emplace_back();
  header.unnamed_end = empty_end;
  header.units.resize(rows_.fields);
  for (std::size_t i = 0; i < rows_.fields; ++i) {
    const NameAndUnit name = split_unit(header.names[i]);
    header.names[i] = name.name.empty() ? fmt::format("{}", i + 1) : name.name;
    header.units[i] = name.unit;
  }
  make_unique(header.names);
  return header;
}

void LayoutFinder::place_fields(const TextHeader& header) {
  std::vector<std::string> names = header.names;
  names.resize(std::min(names.size(), rows_.fields));
  for (std::size_t i = names.size(); i < rows_.fields; ++i) {
    names.push_back(fmt::format("{}", i + 1));
  }
  std::vector<std::size_t> begins = header.table_begins;
  if (begins.empty()) begins.push_back(0);
  for (std::size_t k = 0; k < begins.size(); ++k) {
    LogTable table;
    if (!header.table_names.empty()) table.name = header.table_names[k];
    const std::size_t end = k + 1 < begins.size() ? begins[k + 1] : rows_.fields;
    for (std::size_t i = begins[k]; i < end; ++i) {
      layout_.fields[i].table = k;
      layout_.fields[i].column = i - begins[k];
      const FieldKind kind = layout_.fields[i].kind;
      const bool seconds = kind == FieldKind::kInstant || kind == FieldKind::kTimeOfDay;
      table.columns.push_back(names[i]);
      table.units.push_back(seconds ? "s" : header.units[i]);
    }
    layout_.tables.push_back(std::move(table));
  }
  // What `rostopic echo -p` writes: stamps in ns.
  if (names.front() == "%time") {
    LogTable& table = layout_.tables.front();
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const bool stamp = i == 0 || table.columns[i].ends_with(".stamp");
      if (stamp && layout_.fields[i].kind == FieldKind::kWhole) table.units[i] = "ns";
    }
  }
}

void LayoutFinder::tell(const TextHeader& header) const {
  if (rows_.separator != ',' && rows_.fields > 1) {
    log_->add_once("separator", line_of_row(0).number, 1,
                   fmt::format("columns are separated by {}", separator_name(rows_.separator)));
  }
  if (header.line == 0 && !settings_->columns) {
    log_->add_once("no names", line_of_row(0).number, 1,
                   fmt::format("no line names the columns; they are 1 to {}", rows_.fields));
  }
  const std::size_t told = header.line != 0 ? header.line : line_of_row(0).number;
  if (begin_ < sample_->size() && (*sample_)[begin_].number < told) {
    log_->add_once("preamble", (*sample_)[begin_].number, 1,
                   fmt::format("what stands before line {} is not read", told));
  }
  std::string texts, counted;
  for (std::size_t i = 0; i < rows_.fields; ++i) {
    const TextField& field = layout_.fields[i];
    const std::string name = in_quotes(layout_.tables[field.table].columns[field.column]);
    if (field.kind == FieldKind::kText) texts += (texts.empty() ? "" : ", ") + name;
    if (field.kind != FieldKind::kText && field.kind != FieldKind::kNumber) {
      counted += (counted.empty() ? "" : ", ") + name;
    }
  }
  if (!texts.empty()) {
    log_->add_once("texts", line_of_row(0).number, 1,
                   fmt::format("words stand in {}; they have no values", texts));
  }
  if (!counted.empty()) {
    log_->add_once("counted", line_of_row(0).number, 1,
                   fmt::format("{}: counted from the first value", counted));
  }
  if (layout_.tables.size() > 1) {
    log_->add_once(
        "tables", header.line, 1,
        fmt::format("{} signals have times of their own; each is a table", layout_.tables.size()));
  }
}

TextLayout LayoutFinder::find() {
  find_rows();
  find_decimal();
  find_kinds();
  const TextHeader header =
      settings_->columns ? given_columns() : find_text_header(*sample_, begin_, rows_, *log_);
  layout_.header_line = header.line;
  layout_.header = header.text;
  if (header.unnamed_end && rows_.fields > 1 && rows_.column_kinds.back() == WordKind::kMissing) {
    --rows_.fields;
    layout_.fields.pop_back();
    log_->add_once("end", line_of_row(0).number, line_of_row(0).text.size(),
                   "rows end with a separator; ignored");
  }
  place_fields(header);
  tell(header);
  return layout_;
}

}  // namespace

bool is_comment(std::string_view line) {
  line = trimmed(line);
  if (line.starts_with('#')) {  // but "#N/A" is a value
    return kind_of_word(line.substr(0, line.find_first_of(",;|\t "))) != WordKind::kMissing;
  }
  if (line.starts_with('%')) return !line.starts_with("%time");
  return line.starts_with("//") || line.starts_with('*');
}

TextLayout find_layout(const std::vector<SampleLine>& sample, bool whole,
                       const LogTextSettings& settings, NoticeLog& log) {
  return LayoutFinder(sample, whole, settings, log).find();
}

}  // namespace dyngen::runtime
