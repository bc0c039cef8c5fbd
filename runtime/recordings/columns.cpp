// SPDX-License-Identifier: MIT
#include "runtime/recordings/columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>

namespace dyngen::runtime {
namespace {

enum class Kind { kTime, kQ, kTau, kDq, kDdq, kTauSim, kLinkQ, kTemperature, kSegment };

struct Spelling {
  std::string_view word;
  Kind kind;
};

constexpr std::array<Spelling, 15> kNumbered = {{{"q", Kind::kQ},
                                                 {"tau", Kind::kTau},
                                                 {"qd", Kind::kDq},
                                                 {"dq", Kind::kDq},
                                                 {"qdd", Kind::kDdq},
                                                 {"ddq", Kind::kDdq},
                                                 {"tausim", Kind::kTauSim},
                                                 {"tau_sim", Kind::kTauSim},
                                                 {"ql", Kind::kLinkQ},
                                                 {"q_link", Kind::kLinkQ},
                                                 {"qlink", Kind::kLinkQ},
                                                 {"temp", Kind::kTemperature},
                                                 {"temp_", Kind::kTemperature},
                                                 {"temperature", Kind::kTemperature},
                                                 {"temperature_", Kind::kTemperature}}};

constexpr int kMostJoints = 1000;
constexpr int kOfAllJoints = -1;  // number of a temperature without one

/// What a name means; number 0 where it has none.
struct Meaning {
  Kind kind = Kind::kTime;
  int number = 0;
  std::string_view unit{};  ///< of the name, without brackets; empty if it has none
};

std::optional<Meaning> meaning_of_word(std::string_view name) {
  std::string lower(name);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (lower == "time") return Meaning{Kind::kTime, 0};
  if (lower == "segment") return Meaning{Kind::kSegment, 0};
  if (lower == "temp" || lower == "temperature") {
    return Meaning{Kind::kTemperature, kOfAllJoints};
  }
  const std::size_t digits = std::min(lower.find_first_of("0123456789"), lower.size());
  const std::string_view word = std::string_view(lower).substr(0, digits);
  const std::string_view number = std::string_view(lower).substr(digits);
  const auto spelled = std::find_if(kNumbered.begin(), kNumbered.end(),
                                    [&](const Spelling& known) { return known.word == word; });
  if (spelled == kNumbered.end() || number.empty() || number.size() > 4) return std::nullopt;
  int value = 0;
  const auto [stop, error] = std::from_chars(number.begin(), number.end(), value);
  if (error != std::errc() || stop != number.end()) return std::nullopt;
  return Meaning{spelled->kind, value};
}

ColumnQuantity quantity_of(Kind kind) {
  switch (kind) {
    case Kind::kTime:
      return ColumnQuantity::kTime;
    case Kind::kDq:
      return ColumnQuantity::kVelocity;
    case Kind::kDdq:
      return ColumnQuantity::kAcceleration;
    case Kind::kTau:
    case Kind::kTauSim:
      return ColumnQuantity::kTorque;
    case Kind::kTemperature:
      return ColumnQuantity::kTemperature;
    case Kind::kQ:
    case Kind::kLinkQ:
    case Kind::kSegment:
      break;
  }
  return ColumnQuantity::kPosition;
}

/// The meaning of a name that may end with a unit. What stands in brackets is always one; what
/// follows a '_' only if it is known ("q1_filtered" is another column).
std::optional<Meaning> meaning_of(std::string_view name) {
  if (const auto plain = meaning_of_word(name)) return plain;
  if (const std::size_t open = name.find_first_of("[(<{"); open != name.npos && open > 0) {
    const std::string_view unit = trimmed(name.substr(open));
    std::string_view word = trimmed(name.substr(0, open));
    while (word.ends_with('_')) word.remove_suffix(1);
    std::optional<Meaning> meaning = meaning_of_word(word);
    const std::string_view inside = without_brackets(unit);
    if (meaning && meaning->kind != Kind::kSegment && inside.size() < unit.size()) {
      meaning->unit = inside;
      return meaning;
    }
    return std::nullopt;
  }
  for (std::size_t at = name.find_first_of("_ /"); at != name.npos;
       at = name.find_first_of("_ /", at + 1)) {
    std::optional<Meaning> meaning = meaning_of_word(name.substr(0, at));
    const std::string_view unit = trimmed(name.substr(at + 1));
    if (meaning && meaning->kind != Kind::kSegment &&
        unit_conversion(unit, quantity_of(meaning->kind))) {
      meaning->unit = unit;
      return meaning;
    }
  }
  return std::nullopt;
}

/// A unit as it was written, or in ASCII.
std::string shown_unit(std::string_view word) {
  const bool ascii =
      std::all_of(word.begin(), word.end(), [](char c) { return c >= ' ' && c <= '~'; });
  return ascii ? std::string(word) : plain_unit(word);
}

/// "q1 and q2 in deg, time in ms" of the columns that have a unit which is not SI.
std::string converted_columns(const Columns& columns, const std::vector<std::string>& units) {
  std::vector<std::pair<std::string, std::vector<std::string>>> by_unit;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (columns.target[i] < 0 || !columns.conversions[i].changes()) continue;
    auto same = std::find_if(by_unit.begin(), by_unit.end(),
                             [&](const auto& entry) { return entry.first == units[i]; });
    if (same == by_unit.end()) same = by_unit.insert(by_unit.end(), {units[i], {}});
    same->second.push_back(quoted(std::string_view(columns.names[i])));
  }
  std::string text;
  for (const auto& [unit, names] : by_unit) {
    constexpr std::size_t kNamed = 3;
    const std::vector<std::string> first(
        names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kNamed)));
    text += fmt::format(
        "{}{}{} in {}", text.empty() ? "" : "; ", fmt::join(first, ", "),
        names.size() > kNamed ? fmt::format(" and {} more", names.size() - kNamed) : std::string(),
        unit);
  }
  return text;
}

/// The numbered columns of one kind: their numbers and where they stand.
struct ColumnGroup {
  std::map<int, std::size_t> fields;  ///< number -> field

  [[nodiscard]] int count() const { return static_cast<int>(fields.size()); }
};

class HeaderReader {
 public:
  HeaderReader(std::string_view line, std::size_t line_number, NoticeLog& log)
      : line_(line), line_number_(line_number), log_(&log) {}

  Columns read(char separator, int joints, bool torque_required);

 private:
  [[noreturn]] void fail(std::size_t column, const std::string& message) const {
    throw recording_error(log_->file(), line_number_, column, message);
  }
  void choose_separator(char separator);
  void sort_out_names();
  void read_unit(const Field& field, const Meaning& meaning, std::size_t place);
  void check_group(Kind kind, std::string_view word, int expected) const;
  void find_links(SampleLayout& layout) const;
  void settle_common_temperature();
  void place(Kind kind, int& next);
  ColumnGroup& group(Kind kind) { return groups_[static_cast<std::size_t>(kind)]; }
  [[nodiscard]] const ColumnGroup& group(Kind kind) const {
    return groups_[static_cast<std::size_t>(kind)];
  }

  std::string_view line_;
  std::size_t line_number_;
  NoticeLog* log_;
  Columns columns_;
  std::vector<Field> fields_;
  std::array<ColumnGroup, 9> groups_;
  std::vector<std::string> units_;  ///< per field
};

void HeaderReader::choose_separator(char separator) {
  const char chosen = separator == '\0' ? separator_of(line_) : separator;
  columns_.separator.character = chosen;
  fields_ = split_fields(line_, columns_.separator);
  if (chosen != ',' && fields_.size() > 1) {
    const std::string name = chosen == ';'    ? "semicolons"
                             : chosen == '\t' ? "tabs"
                             : chosen == ' '  ? "blanks"
                                              : fmt::format("'{}'", chosen);
    log_->add_once(
        "separator", line_number_, 1,
        fmt::format("columns are separated by {}; accepted, and a decimal comma too", name));
  }
  if (fields_.size() > 1 && fields_.back().text.empty()) {
    log_->add_once("trailing header", line_number_, fields_.back().column,
                   "the header ends with a separator; ignored");
    fields_.pop_back();
  }
}

void HeaderReader::read_unit(const Field& field, const Meaning& meaning, std::size_t place) {
  columns_.quantities[place] = quantity_of(meaning.kind);
  if (meaning.unit.empty()) return;
  const auto conversion = unit_conversion(meaning.unit, columns_.quantities[place]);
  if (!conversion) {
    fail(field.column, fmt::format("found unit {} of {}, expected {}", quoted(meaning.unit),
                                   quoted(field.text), known_units(columns_.quantities[place])));
  }
  columns_.conversions[place] = *conversion;
  columns_.converts = columns_.converts || conversion->changes();
  units_[place] = shown_unit(meaning.unit);
}

void HeaderReader::sort_out_names() {
  columns_.target.assign(fields_.size(), Columns::kIgnored);
  columns_.quantities.assign(fields_.size(), ColumnQuantity::kPosition);
  columns_.conversions.assign(fields_.size(), {});
  units_.assign(fields_.size(), {});
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const Field& field = fields_[i];
    columns_.names.emplace_back(field.text);
    const std::optional<Meaning> meaning = meaning_of(field.text);
    if (!meaning) {
      log_->add_once(
          fmt::format("unknown {}", i), line_number_, field.column,
          fmt::format("found column {}, which means nothing here; ignored", quoted(field.text)));
      continue;
    }
    const bool numbered = meaning->kind != Kind::kTime && meaning->kind != Kind::kSegment;
    const bool of_all = meaning->kind == Kind::kTemperature && meaning->number == kOfAllJoints;
    if (numbered && !of_all && (meaning->number < 1 || meaning->number > kMostJoints)) {
      fail(field.column, fmt::format("found column {}, expected numbers from 1 to {}",
                                     quoted(field.text), kMostJoints));
    }
    read_unit(field, *meaning, i);
    const auto [place, is_new] = group(meaning->kind).fields.emplace(meaning->number, i);
    if (!is_new) {
      const Field& first = fields_[place->second];
      fail(field.column,
           fmt::format("found column {} for a second time (the first is {} in column {}), expected "
                       "each once",
                       quoted(field.text), quoted(first.text), first.column));
    }
  }
}

/// Numbers 1 .. count without a gap; `expected` of them if that is not 0.
void HeaderReader::check_group(Kind kind, std::string_view word, int expected) const {
  int next = 1;
  std::size_t last_column = 1;
  for (const auto& [number, place] : group(kind).fields) {
    const Field& field = fields_[place];
    if (number != next) {
      fail(field.column,
           fmt::format("found column {} without '{}{}', expected {}1, {}2, ... with no "
                       "gap",
                       quoted(field.text), word, next, word, word));
    }
    if (expected != 0 && number > expected) {
      fail(field.column, fmt::format("found column {}, expected {}1 to {}{} for {} joints",
                                     quoted(field.text), word, word, expected, expected));
    }
    last_column = field.column;
    ++next;
  }
  if (expected != 0 && next <= expected) {
    fail(last_column, fmt::format("found no column '{}{}', expected {}1 to {}{} for {} joints",
                                  word, next, word, word, expected, expected));
  }
}

/// A temperature without a number is that of all joints, unless joints have their own.
void HeaderReader::settle_common_temperature() {
  auto& fields = group(Kind::kTemperature).fields;
  const auto common = fields.find(kOfAllJoints);
  if (common == fields.end()) return;
  const std::size_t place = common->second;
  fields.erase(common);
  if (fields.empty()) {
    fields.emplace(1, place);
    return;
  }
  log_->add_once("common temperature", line_number_, fields_[place].column,
                 fmt::format("found column {} beside temperatures of joints; ignored",
                             quoted(fields_[place].text)));
}

/// Some joints alone may have a second encoder: numbers may have gaps.
void HeaderReader::find_links(SampleLayout& layout) const {
  for (const auto& [number, place] : group(Kind::kLinkQ).fields) {
    const Field& field = fields_[place];
    if (number > layout.joints) {
      fail(field.column, fmt::format("found column {}, expected ql1 to ql{} for {} joints",
                                     quoted(field.text), layout.joints, layout.joints));
    }
    layout.links.push_back({number - 1, line_number_, field.column});
  }
}

void HeaderReader::place(Kind kind, int& next) {
  for (const auto& [number, place] : group(kind).fields) columns_.target[place] = next++;
}

Columns HeaderReader::read(char separator, int joints, bool torque_required) {
  columns_.header_line = line_number_;
  choose_separator(separator);
  sort_out_names();

  const std::string example =
      fmt::format("expected a header such as 'time,q1,q2{}'", torque_required ? ",tau1,tau2" : "");
  if (group(Kind::kTime).fields.empty()) {
    fail(fields_.empty() ? 1 : fields_.front().column,
         fmt::format("found no column 'time' in {}, {}; other names and units are read by a map "
                     "('dynid import --guess' writes one)",
                     quoted(trimmed(line_)), example));
  }
  for (const auto& [kind, word] : {std::pair{Kind::kQ, "q"}, std::pair{Kind::kTau, "tau"}}) {
    if (group(kind).fields.empty() && (kind == Kind::kQ || torque_required)) {
      fail(fields_.back().column, fmt::format("found no column '{}1', {}", word, example));
    }
  }
  check_group(Kind::kQ, "q", joints);
  SampleLayout& layout = columns_.layout;
  layout.joints = group(Kind::kQ).count();
  const auto recorded = [&](Kind kind, std::string_view word) {
    const bool there = !group(kind).fields.empty();
    if (there) check_group(kind, word, layout.joints);
    return there;
  };
  layout.tau = recorded(Kind::kTau, "tau");
  layout.dq = recorded(Kind::kDq, "qd");
  layout.ddq = recorded(Kind::kDdq, "qdd");
  layout.tau_sim = recorded(Kind::kTauSim, "tausim");
  find_links(layout);
  settle_common_temperature();
  check_group(Kind::kTemperature, "temp", 0);
  layout.temperatures = group(Kind::kTemperature).count();

  int next = 0;
  for (const Kind kind : {Kind::kTime, Kind::kQ, Kind::kTau, Kind::kDq, Kind::kDdq, Kind::kTauSim,
                          Kind::kLinkQ, Kind::kTemperature}) {
    place(kind, next);
  }
  for (const auto& [number, place] : group(Kind::kSegment).fields) {
    columns_.target[place] = Columns::kSegment;
  }
  if (columns_.converts) {
    log_->add_once("units", line_number_, 1,
                   fmt::format("found {}; converted to SI", converted_columns(columns_, units_)));
  }
  return columns_;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<Field> split_fields(std::string_view line, Separator separator) {
  const bool blanks = separator.character == ' ';
  std::vector<Field> fields;
  std::size_t place = 0;
  const auto skip_blanks = [&] {
    while (place < line.size() && is_blank(line[place]) && line[place] != separator.character) {
      ++place;
    }
    while (blanks && place < line.size() && is_blank(line[place])) ++place;
  };
  for (;;) {
    skip_blanks();
    if (blanks && place == line.size() && !fields.empty()) return fields;
    const std::size_t begin = place;
    const bool in_quotes = place < line.size() && (line[place] == '"' || line[place] == '\'');
    if (in_quotes) {
      const std::size_t close = line.find(line[place], place + 1);
      if (close != line.npos) place = close;
    }
    while (place < line.size() &&
           !(blanks ? is_blank(line[place]) : line[place] == separator.character)) {
      ++place;
    }
    std::string_view text = trimmed(line.substr(begin, place - begin));
    if (in_quotes && text.size() >= 2 && text.back() == text.front()) {
      text = trimmed(text.substr(1, text.size() - 2));
    }
    fields.push_back({text, begin + 1});
    if (place == line.size()) return fields;
    ++place;
    if (place == line.size() && blanks) return fields;
  }
}

bool looks_like_header(std::string_view line) {
  for (const char separator : {',', ';', '\t', ' '}) {
    for (const Field& field : split_fields(line, {separator})) {
      const std::optional<Meaning> meaning = meaning_of(field.text);
      if (meaning && meaning->kind == Kind::kTime) return true;
    }
  }
  return false;
}

char separator_of(std::string_view line) {
  for (const char separator : {';', ',', '\t'}) {
    if (line.find(separator) != line.npos) return separator;
  }
  return ' ';
}

char told_separator(std::string_view line) {
  const std::string_view text = line.substr(0, line.find_last_not_of("\" ") + 1);
  const std::size_t begin = text.find_first_not_of("\" ");
  if (begin == text.npos || text.size() - begin < 5) return '\0';
  std::string word(text.substr(begin, 4));
  for (char& c : word) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return word == "sep=" && text.size() - begin == 5 ? text[begin + 4] : '\0';
}

Columns read_header(std::string_view line, std::size_t line_number, char separator, int joints,
                    bool torque_required, NoticeLog& log) {
  return HeaderReader(line, line_number, log).read(separator, joints, torque_required);
}

bool read_unit_row(std::string_view line, std::size_t line_number, Columns& columns,
                   NoticeLog& log) {
  std::vector<Field> fields = split_fields(line, columns.separator);
  while (fields.size() > columns.target.size() && fields.back().text.empty()) fields.pop_back();
  if (fields.size() != columns.target.size()) return false;
  std::size_t used = 0, units = 0;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string_view text = without_brackets(fields[i].text);
    if (columns.target[i] < 0 || text.empty() || text == "-") continue;
    ++used;
    const bool is_unit = unit_conversion(fields[i].text, columns.quantities[i]).has_value();
    units += is_unit ? 1 : 0;
    constexpr std::string_view kNumberBegins = "+-.0123456789";
    const bool number = !text.empty() && kNumberBegins.find(text.front()) != kNumberBegins.npos;
    if (columns.target[i] == 0 && number && !is_unit) return false;
  }
  if (units == 0 || 2 * units < used) return false;

  std::vector<std::string> names(fields.size());
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (columns.target[i] < 0) continue;
    const std::string_view text = without_brackets(fields[i].text);
    if (text.empty() || text == "-") continue;  // as the header says, or SI
    const auto conversion = unit_conversion(text, columns.quantities[i]);
    if (!conversion) {
      throw recording_error(log.file(), line_number, fields[i].column,
                            fmt::format("found unit {} of column {}, expected {}", quoted(text),
                                        quoted(std::string_view(columns.names[i])),
                                        known_units(columns.quantities[i])));
    }
    if (columns.conversions[i].changes() && *conversion != columns.conversions[i]) {
      throw recording_error(
          log.file(), line_number, fields[i].column,
          fmt::format("found unit {} of column {}, expected the unit in its name, or none",
                      quoted(text), quoted(std::string_view(columns.names[i]))));
    }
    columns.conversions[i] = *conversion;
    columns.converts = columns.converts || conversion->changes();
    names[i] = shown_unit(text);
  }
  const std::string converted = converted_columns(columns, names);
  log.add_once("unit row", line_number, 1,
               converted.empty()
                   ? "found a row of units, all of them SI; read"
                   : fmt::format("found a row of units: {}; converted to SI", converted));
  return true;
}

}  // namespace dyngen::runtime
