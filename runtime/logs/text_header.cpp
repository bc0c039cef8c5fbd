// SPDX-License-Identifier: MIT
#include "runtime/logs/text_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "runtime/logs/log_error.h"
#include "runtime/recordings/columns.h"
#include "runtime/recordings/text_encoding.h"

namespace dyngen::runtime {
namespace {

using Words = std::vector<std::string>;

std::string small_letters(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> known) {
  return std::find(known.begin(), known.end(), word) != known.end();
}

bool names_time(std::string_view text) {
  const std::string name = small_letters(split_unit(text).name);
  if (is_one_of(name, {"time", "t", "zeit", "timestamp", "time stamp", "uhrzeit", "x"}))
    return true;
  return std::any_of(name.begin(), name.end(), [](char c) { return c >= 'a' && c <= 'z'; }) &&
         (name.ends_with("time") || name.ends_with("zeit") || name.ends_with("timestamp") ||
          name.ends_with(".t") || name.ends_with("_t"));
}

/// What a line names, as UTF-8; a comment's words without the mark of the comment.
Words words_of(const SampleLine& line, const SampleRows& rows) {
  std::string_view text = line.text;
  if (is_comment(text)) {
    const std::size_t begin = text.find_first_not_of("#%/* \t");
    text = begin == text.npos ? std::string_view() : text.substr(begin);
  }
  std::string kept(text);
  if (rows.separator == ' ') {  // "A1 [deg]" is one name
    for (std::size_t at = kept.find_first_of(" \t"); at != kept.npos;
         at = kept.find_first_of(" \t", at + 1)) {
      const std::size_t next = kept.find_first_not_of(" \t", at);
      if (next != kept.npos && (kept[next] == '[' || kept[next] == '(') && at > 0) {
        kept.erase(at, next - at);
      }
    }
  }
  Words words;
  for (const std::string_view word : fields_of(kept, rows.separator, rows.fields)) {
    words.push_back(as_utf8(word));
  }
  if (words.size() == 1 && words.front().empty()) words.clear();
  return words;
}

bool is_unit_row(const Words& words, std::size_t fields) {
  if (words.size() > fields) return false;
  std::size_t known = 0, other = 0;
  for (const std::string& word : words) {
    const std::string_view inside = without_brackets(word);
    if (inside.empty() || inside == "-") continue;
    const bool bracketed = inside.size() < word.size();
    const bool number = kind_of_word(word) == WordKind::kNumber && word != "1";
    (!number && (bracketed || is_log_unit(word)) ? known : other) += 1;
  }
  return known > 0 && known >= 2 * other;
}

bool is_text_row(const Words& words) {
  return !words.empty() && std::any_of(words.begin(), words.end(), [](const std::string& word) {
    const WordKind kind = kind_of_word(word);
    return kind == WordKind::kText;
  });
}

/// A key that stands before every value of a line; empty if there is none.
std::string key_of_pairs(const Words& words) {
  if (words.size() < 2 || words.front().empty()) return {};
  for (std::size_t i = 2; i < words.size(); i += 2) {
    if (words[i] != words[0] && !words[i].empty()) return {};
  }
  std::string key = small_letters(words[0]);
  while (!key.empty() && (key.back() == ':' || key.back() == ' ')) key.pop_back();
  return key;
}

class HeaderFinder {
 public:
  HeaderFinder(const std::vector<SampleLine>& sample, std::size_t begin, const SampleRows& rows,
               NoticeLog& log)
      : sample_(&sample), begin_(begin), rows_(&rows), log_(&log) {}

  TextHeader find();

 private:
  [[nodiscard]] std::size_t first_row() const { return rows_->rows.front(); }
  [[nodiscard]] bool has_names_before(std::size_t index) const;
  void take_units(const Words& words, const SampleLine& line);
  bool find_pairs();
  void take_names(const Words& words, const SampleLine& line);
  void find_own_times(const Words& words);
  [[nodiscard]] Words with_names_above(const Words& words, std::size_t index) const;
  [[noreturn]] void refuse(const Words& words, const SampleLine& line) const;

  const std::vector<SampleLine>* sample_;
  std::size_t begin_;
  const SampleRows* rows_;
  NoticeLog* log_;
  TextHeader header_;
};

void HeaderFinder::take_units(const Words& words, const SampleLine& line) {
  for (std::size_t i = 0; i < words.size() && i < rows_->fields; ++i) {
    const std::string_view unit = without_brackets(words[i]);
    if (unit != "-") header_.units[i] = std::string(unit);
  }
  log_->add_once("unit row", line.number, 1, "found a row of units; read");
}

/// "Name;A1;Name;A2": a key before each signal's name, and data in pairs of time and value.
bool HeaderFinder::find_pairs() {
  if (rows_->fields < 2 || rows_->fields % 2 != 0) return false;
  Words names, units;
  std::size_t line = 0;
  for (std::size_t i = begin_; i < first_row(); ++i) {
    const Words words = words_of((*sample_)[i], *rows_);
    // a preamble of one signal cannot be told from other keys and values, but for these words
    const bool whole = words.size() == rows_->fields || words.size() + 1 == rows_->fields;
    const std::string key = whole ? key_of_pairs(words) : std::string();
    Words values;
    for (std::size_t k = 1; k < words.size(); k += 2) values.push_back(words[k]);
    values.resize(rows_->fields / 2);
    if (is_one_of(key, {"name", "symbolname", "symbol name", "variable", "variable name", "signal",
                        "signal name", "signalname", "channel"})) {
      names = values;
      line = i;
    } else if (is_one_of(key, {"unit", "units", "einheit", "unit name"})) {
      units = values;
    }
  }
  if (names.empty() || std::all_of(names.begin(), names.end(),
                                   [](const std::string& name) { return name.empty(); })) {
    return false;
  }
  make_unique(names);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const NameAndUnit signal = split_unit(names[k]);
    header_.table_begins.push_back(2 * k);
    header_.table_names.push_back(signal.name);
    header_.names.insert(header_.names.end(), {"time", signal.name});
    header_.units[2 * k + 1] = !units.empty() && !units[k].empty() ? units[k] : signal.unit;
  }
  header_.unnamed_end = false;
  header_.line = (*sample_)[line].number;
  header_.text = (*sample_)[line].text;
  return true;
}

/// Names of two levels, a line each: "joint" above "a" is "joint.a".
/// @param index  of the lower line
Words HeaderFinder::with_names_above(const Words& words, std::size_t index) const {
  const std::set<std::string> different(words.begin(), words.end());
  const bool complete = different.size() == words.size() && !different.contains("");
  if (complete || index == begin_) return words;
  const Words above = words_of((*sample_)[index - 1], *rows_);
  if (above.size() != words.size() || !is_text_row(above)) return words;
  Words joined;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool both = !above[i].empty() && !words[i].empty();
    joined.push_back(above[i] + (both ? "." : "") + words[i]);
  }
  return joined;
}

/// Columns of time that come again begin a table each.
void HeaderFinder::find_own_times(const Words& words) {
  std::vector<std::size_t> times;
  std::set<std::string> different;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!names_time(words[i])) continue;
    times.push_back(i);
    different.insert(small_letters(words[i]));
  }
  if (times.size() < 2 || times.front() != 0 || times.back() + 1 == words.size()) return;
  bool pairs = 2 * times.size() == words.size(), apart = true;
  for (std::size_t k = 0; k < times.size(); ++k) {
    pairs = pairs && times[k] == 2 * k;
    apart = apart && (k == 0 || times[k] > times[k - 1] + 1);
  }
  if (!apart || (!pairs && different.size() > 1)) return;
  header_.table_begins = times;
  for (const std::size_t time : times)
    header_.table_names.push_back(split_unit(words[time + 1]).name);
  make_unique(header_.table_names);
}

void HeaderFinder::refuse(const Words& words, const SampleLine& line) const {
  throw recording_error(
      log_->file(), line.number, 1,
      fmt::format("found {} names before rows of {} values (line {}), expected as many; name the "
                  "columns of the file yourself, or say how many lines to skip",
                  words.size(), rows_->fields, (*sample_)[first_row()].number));
}

void HeaderFinder::take_names(const Words& words, const SampleLine& line) {
  header_.line = line.number;
  header_.text = line.text;
  header_.unnamed_end = words.size() < rows_->fields || words.back().empty();
  find_own_times(words);
  Words names;
  for (std::size_t i = 0; i < rows_->fields; ++i) {
    const NameAndUnit name = i < words.size() ? split_unit(words[i]) : NameAndUnit();
    names.push_back(name.name);
    if (!name.unit.empty()) header_.units[i] = name.unit;
  }
  // "A1 [deg]" and "A1 [Nm]" are told apart by their units
  const std::set<std::string> different(names.begin(), names.end());
  if (header_.table_begins.empty() && different.size() < names.size()) {
    std::multiset<std::string> counts(names.begin(), names.end());
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (counts.count(names[i]) > 1 && !words[i].empty()) names[i] = words[i];
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) names[i] = fmt::format("{}", i + 1);
  }
  if (header_.table_begins.empty()) {
    const Words again = make_unique(names);
    if (!again.empty()) {
      log_->add_once("names again", line.number, 1,
                     fmt::format("the name {} stands more than once; the others are numbered",
                                 in_quotes(again.front())));
    }
  }
  header_.names = names;
}

/// Letters such as "A" and "V" may be names themselves.
bool HeaderFinder::has_names_before(std::size_t index) const {
  if (index == begin_) return false;
  const Words words = words_of((*sample_)[index - 1], *rows_);
  return is_text_row(words) && (words.size() == rows_->fields || words.size() + 1 == rows_->fields);
}

TextHeader HeaderFinder::find() {
  header_.units.resize(rows_->fields);
  if (find_pairs()) return header_;
  bool units_found = false;
  for (std::size_t i = first_row(); i-- > begin_;) {
    const SampleLine& line = (*sample_)[i];
    const Words words = words_of(line, *rows_);
    if (words.empty()) continue;
    if (!units_found && is_unit_row(words, rows_->fields) && has_names_before(i)) {
      take_units(words, line);
      units_found = true;
      continue;
    }
    const bool text = is_text_row(words);
    if (words.size() == rows_->fields && text) {
      take_names(with_names_above(words, i), line);
      break;
    }
    // LabVIEW names a column of comments that rows leave out
    if (words.size() == rows_->fields + 1 && text && small_letters(words.back()) == "comment") {
      take_names({words.begin(), words.end() - 1}, line);
      break;
    }
    // an empty field at the end of rows has no name
    if (words.size() + 1 == rows_->fields && text &&
        rows_->column_kinds.back() == WordKind::kMissing) {
      take_names(words, line);
      break;
    }
    if (is_comment(line.text)) continue;
    // some lines of prose before nothing but numbers, or names that do not fit
    if (text && words.size() > 1 && 2 * words.size() >= rows_->fields && !units_found) {
      refuse(words, line);
    }
    break;
  }
  return header_;
}

}  // namespace

TextHeader find_text_header(const std::vector<SampleLine>& sample, std::size_t begin,
                            const SampleRows& rows, NoticeLog& log) {
  return HeaderFinder(sample, begin, rows, log).find();
}

}  // namespace dyngen::runtime
