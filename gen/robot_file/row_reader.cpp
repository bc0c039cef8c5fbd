// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_file/row_reader.h"

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "gen/robot_file/expression.h"
#include "gen/robot_file/keywords.h"
#include "gen/robot_file/lexer.h"
#include "gen/robot_file/spelling.h"

namespace dyngen {

namespace {

/// Whether a word that begins a line continues the row above: what Appendix B's reader takes for a
/// number.
bool starts_like_value(std::string_view word) {
  constexpr std::string_view kStarts = "0123456789.+-(*";
  return kStarts.find(word.front()) != kStarts.npos;
}

std::string plural(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

/// A C identifier made of a file's stem: "6dof-arm.v2" gives r6dof_arm_v2.
std::string name_from_stem(const std::string& file_name) {
  std::string name = std::filesystem::path(file_name).stem().string();
  for (char& c : name) {
    if (!is_identifier(std::string("_") + c)) c = '_';
  }
  if (name.empty()) return "robot";
  return is_identifier(name) ? name : "r" + name;
}

SourcePosition end_of(const Word& word) {
  return {word.position.line, word.position.column + word.length};
}

/// A part of a word that has no bad characters, and so is ASCII.
Word part_of(const Word& word, std::size_t offset, std::size_t count) {
  Word part = word;
  part.text = word.text.substr(offset, count);
  part.position.column += static_cast<int>(offset);
  part.length = static_cast<int>(part.text.size());
  return part;
}

class RowReader {
 public:
  RowReader(std::string text, std::string file_name, Diagnostics& diagnostics)
      : diagnostics_(diagnostics) {
    file_.file_name = std::move(file_name);
    file_.text = std::move(text);
    words_ = split_words(file_.text);
  }

  RobotFile read() {
    announce_let_names();
    while (has_next() && !first_.contains(Statement::kStop)) read_row();
    check_end();
    if (file_.name.empty()) file_.name = name_from_stem(file_.file_name);
    return std::move(file_);
  }

 private:
  struct ValueList {
    std::vector<FieldValue> values;
    std::optional<ExactNumber> last;  // the last value, unless it is unknown or wrong
    bool damaged = false;             // by a mistake that also upsets the count, and is reported
  };

  [[nodiscard]] bool has_next() const { return next_ < words_.size(); }
  [[nodiscard]] const Word& peek() const { return words_[next_]; }
  [[nodiscard]] bool at_line_end() const { return !has_next() || peek().begins_line; }
  [[nodiscard]] bool at_keyword() const {
    return has_next() && find_keyword(peek().text) != nullptr;
  }

  const Word& take() {
    names_.mark_used(peek().text);
    return words_[next_++];
  }

  void skip_line() {
    while (!at_line_end()) take();
  }

  void error(const Word& word, std::string message, std::string hint = {}) {
    diagnostics_.error(word.position, word.length, std::move(message), std::move(hint));
  }

  /// `let` names in the whole text, to tell a name declared too late from one never declared.
  void announce_let_names() {
    for (std::size_t i = 0; i + 1 < words_.size(); ++i) {
      const Keyword* keyword = find_keyword(words_[i].text);
      const Word& name = words_[i + 1];
      if (keyword == nullptr || keyword->statement != Statement::kLet) continue;
      if (!name.begins_line && is_identifier(name.text)) names_.announce(name.text, name.position);
    }
  }

  void read_row() {
    const Word& word = take();
    const Keyword* keyword = find_keyword(word.text);
    if (keyword == nullptr) {
      report_no_keyword(word);
      skip_unknown_row();
      return;
    }
    if (keyword->statement == Statement::kValues) {
      read_value_row(word, *keyword);
      return;
    }
    const bool may_repeat =
        keyword->statement == Statement::kLet || keyword->statement == Statement::kEffect;
    if (!may_repeat) check_first(word, keyword->spelling, keyword->statement);
    switch (keyword->statement) {
      case Statement::kName:
        return read_name(word);
      case Statement::kNumberLink:
        return read_number_link(word);
      case Statement::kDh:
        return read_dh(word);
      case Statement::kLet:
        return read_let(word);
      case Statement::kJoints:
        return read_joints(word);
      case Statement::kEffect:
        return read_effect(word);
      case Statement::kStop:
        return read_stop();
      case Statement::kValues:
        return;
    }
  }

  void check_first(const Word& word, std::string_view spelling, Statement statement) {
    const auto [place, is_first] = first_.emplace(statement, word.position);
    if (!is_first) report_duplicate(word, spelling, place->second);
  }

  void report_duplicate(const Word& word, std::string_view spelling, SourcePosition first) {
    error(word, fmt::format("row '{}' stands twice", spelling),
          fmt::format("the first is on line {}", first.line));
  }

  void report_no_keyword(const Word& word) {
    keyword_missed_ = true;
    const std::string shown = printable(word.text);
    if (word.is_bad()) {
      report_bad_character(word, diagnostics_);
    } else if (starts_like_value(word.text) || begins_with_known_name(word.text, names_)) {
      error(word, fmt::format("expected a keyword, found '{}'", shown),
            "a value follows its keyword: d 0 0.5 0");
    } else if (word.text.find('=') != word.text.npos) {
      error(word, fmt::format("expected a keyword, found '{}'", shown),
            "settings stand on the line of their effect");
    } else {
      error(word, fmt::format("unknown keyword '{}'", shown), keyword_hint(word.text));
    }
  }

  /// To the next line that is not a continuation, or to a keyword that follows a value, as where
  /// rows share a line. (A keyword that follows a word is more likely prose: "the d of link 3".)
  void skip_unknown_row() {
    bool after_value = false;
    while (has_next()) {
      const Word& word = peek();
      if (word.begins_line && !starts_like_value(word.text)) return;
      if (after_value && at_keyword()) return;
      after_value = starts_like_value(word.text);
      take();
    }
  }

  // --- rows of values

  void read_value_row(const Word& word, const Keyword& keyword) {
    const bool scalar = is_scalar(keyword.row);
    if (!scalar) require_joint_count(word);
    ValueList list =
        read_values(word, keyword.spelling, scalar ? 1 : joint_count_, may_be_unknown(keyword.row));
    Row& row = file_.rows[static_cast<std::size_t>(keyword.row)];
    if (row.present) {
      report_duplicate(word, keyword.spelling, row.keyword);
      return;
    }
    row = {true, word.position, std::move(list.values)};
  }

  /// Values up to the end of the row, counted.
  ///
  /// @param expected  absent if number_link is missing or wrong: then any number will do
  ValueList read_values(const Word& keyword, std::string_view row, std::optional<int> expected,
                        bool unknown_allowed) {
    ValueList list;
    std::size_t found = 0;
    const auto wanted = static_cast<std::size_t>(expected.value_or(0));
    const Word* last = &keyword;
    const Word* surplus = nullptr;
    bool commas = false;
    bool signs = false;
    while (at_value(expected && found >= wanted)) {
      const Word& word = take();
      ++found;
      commas = commas || word.after_comma;
      signs = signs || (found > 1 && (word.text.front() == '+' || word.text.front() == '-'));
      if (found == 1 && word.after_comma) {
        error(word, fmt::format("no value before ',' in '{}'", row), "delete the ','");
      }
      if (expected && found > wanted) {
        if (surplus == nullptr) surplus = &word;
      } else {
        last = &word;
        read_value(word, row, unknown_allowed, list);
      }
    }
    if (list.damaged || !expected || found == wanted) return list;
    const std::string message =
        fmt::format("expected {} in '{}', found {}", plural(wanted, "value"), row, found);
    std::string hint = takes_joint_count(row) ? fmt::format("number_link is {}", wanted)
                                              : fmt::format("'{}' takes one value", row);
    if (surplus != nullptr) {
      if (signs) hint = "a value holds no blanks: L-0.1, not L - 0.1";
      if (commas) hint = "a comma separates values; a decimal point is '.'";
      error(*surplus, message, hint);
    } else if (has_next() && peek().begins_line && begins_with_known_name(peek().text, names_)) {
      error(peek(), fmt::format("'{}' cannot continue row '{}'", printable(peek().text), row),
            "a line that continues a row begins with a digit or one of . + - ( *");
      take();
      skip_line();
    } else {
      diagnostics_.error(end_of(*last), 1, message, hint);
    }
    return list;
  }

  static bool takes_joint_count(std::string_view row) {
    const Keyword* keyword = find_keyword(row);
    return keyword != nullptr && keyword->statement == Statement::kValues &&
           !is_scalar(keyword->row);
  }

  /// Whether the next word belongs to the row being read. After the last value, a name that is not
  /// a value's is left to be reported as an unknown keyword: rows may share a line.
  [[nodiscard]] bool at_value(bool complete) const {
    if (!has_next() || at_keyword()) return false;
    const Word& word = peek();
    if (word.begins_line) return starts_like_value(word.text);
    return !complete || !is_identifier(word.text) || begins_with_known_name(word.text, names_);
  }

  /// Appends a value to the list; a wrong one as unknown, which no later check looks at.
  void read_value(const Word& word, std::string_view row, bool unknown_allowed, ValueList& list) {
    list.values.push_back({true, 0, word.position, word.length, std::string(word.text)});
    list.last.reset();
    if (list.damaged) return;  // the pieces of one value need no message each
    if (word.is_bad()) {
      report_bad_character(word, diagnostics_);
      list.damaged = true;
    } else if (word.text == "*") {
      if (unknown_allowed) return;
      error(word, fmt::format("'*' (unknown) cannot stand in '{}'", row),
            "it can stand in m mX mY mZ XX XY XZ YY YZ ZZ IA Fs Fv off d r gx gy gz");
    } else {
      Evaluation evaluation = evaluate(word, row, names_, diagnostics_);
      list.damaged = evaluation.cut_off;
      if (!evaluation.number) return;
      list.values.back().unknown = false;
      list.values.back().value = evaluation.number->exact();
      list.last = std::move(evaluation.number);
    }
  }

  void require_joint_count(const Word& word) {
    if (first_.contains(Statement::kNumberLink) || joint_count_reported_) return;
    joint_count_reported_ = true;
    for (std::size_t i = next_; i < words_.size(); ++i) {
      const Keyword* later = find_keyword(words_[i].text);
      if (later == nullptr || later->statement != Statement::kNumberLink) continue;
      error(word, fmt::format("'{}' stands before number_link", printable(word.text)),
            fmt::format("move number_link up from line {}", words_[i].position.line));
      return;
    }
    if (keyword_missed_) return;
    error(word, fmt::format("'{}' stands before number_link", printable(word.text)),
          "begin with the number of joints: number_link 6");
  }

  void read_number_link(const Word& word) {
    const ValueList list = read_values(word, "number_link", 1, false);
    if (list.values.empty() || list.values.front().unknown || joint_count_) return;
    const FieldValue& value = list.values.front();
    const bool in_range = value.value.info(GiNaC::info_flags::integer) && value.value >= 1 &&
                          value.value <= kMaxJoints;
    if (!in_range) {
      diagnostics_.error(value.position, value.length,
                         fmt::format("number_link is {}", printable(value.text)),
                         fmt::format("expected an integer from 1 to {}", kMaxJoints));
      return;
    }
    joint_count_ = GiNaC::ex_to<GiNaC::numeric>(value.value).to_int();
    file_.joint_count = *joint_count_;
  }

  // --- rows of names

  /// The one name that a row has, or null if it is missing or wrong, which is reported.
  const Word* read_one_name(const Word& keyword, std::string_view row) {
    if (at_line_end()) {
      diagnostics_.error(end_of(keyword), 1, fmt::format("expected a name after '{}'", row));
      return nullptr;
    }
    if (at_keyword()) {
      const Word& word = peek();
      error(word, fmt::format("the keyword '{}' is no name for '{}'", printable(word.text), row),
            "choose another name");
      const bool begins_row = next_ + 1 < words_.size() && !words_[next_ + 1].begins_line &&
                              starts_like_value(words_[next_ + 1].text);
      if (!begins_row || row == "let") skip_line();
      return nullptr;
    }
    const Word& word = take();
    return check_name(word, row) ? &word : nullptr;
  }

  bool check_name(const Word& word, std::string_view row) {
    if (word.is_bad()) {
      report_bad_character(word, diagnostics_);
      return false;
    }
    if (is_identifier(word.text)) return true;
    error(word, fmt::format("'{}' is not a name, in '{}'", printable(word.text), row),
          "a name is letters, digits and '_', and does not begin with a digit");
    return false;
  }

  void check_nothing_follows(std::string_view row) {
    if (at_line_end() || at_keyword()) return;
    error(peek(), fmt::format("unexpected '{}' after '{}'", printable(peek().text), row),
          fmt::format("'{}' takes one word", row));
    skip_line();
  }

  void read_name(const Word& keyword) {
    const Word* word = read_one_name(keyword, "name");
    if (word != nullptr) file_.name = word->text;
    check_nothing_follows("name");
  }

  void read_dh(const Word& keyword) {
    constexpr std::string_view kExpected = "expected modified (Khalil, Craig) or standard (distal)";
    if (at_line_end() || at_keyword()) {
      diagnostics_.error(end_of(keyword), 1, "'dh' names no convention", std::string(kExpected));
      return;
    }
    const Word& word = take();
    const std::string lower = lower_case(word.text);
    if (lower == "standard") {
      file_.convention = DhConvention::kStandard;
    } else if (lower != "modified") {
      error(word, fmt::format("unknown convention '{}' in 'dh'", printable(word.text)),
            std::string(kExpected));
    }
    check_nothing_follows("dh");
  }

  void read_let(const Word& keyword) {
    const Word* name = read_one_name(keyword, "let");
    if (name == nullptr) {
      skip_line();
      return;
    }
    const bool builtin = is_builtin_name(name->text);
    if (builtin) {
      error(*name, fmt::format("'{}' is built in and cannot be declared", name->text),
            "choose another name");
    }
    ValueList list = read_values(*name, printable(name->text), 1, false);
    if (builtin) return;
    if (const LetNames::Entry* first = names_.find(name->text)) {
      error(*name, fmt::format("'{}' is declared twice", printable(name->text)),
            fmt::format("the first is on line {}", first->position.line));
      return;
    }
    names_.declare(name->text, name->position, std::move(list.last));
  }

  void read_joints(const Word& keyword) {
    require_joint_count(keyword);
    std::map<std::string_view, const Word*> first;
    std::vector<std::string> joint_names;
    const Word* last = &keyword;
    while (!at_line_end() && !at_keyword()) {
      last = &take();
      joint_names.emplace_back(last->text);
      if (!check_name(*last, "joints")) continue;
      const auto [place, is_first] = first.emplace(last->text, last);
      if (is_first) continue;
      error(*last, fmt::format("joint name '{}' stands twice", printable(last->text)),
            fmt::format("the first is in column {}", place->second->position.column));
    }
    if (joint_count_ && joint_names.size() != static_cast<std::size_t>(*joint_count_)) {
      const bool keyword_as_name = at_keyword() && !peek().begins_line;
      diagnostics_.error(
          end_of(*last), 1,
          fmt::format("expected {} in 'joints', found {}",
                      plural(static_cast<std::size_t>(*joint_count_), "name"), joint_names.size()),
          keyword_as_name
              ? fmt::format("the keyword '{}' cannot name a joint", printable(peek().text))
              : fmt::format("number_link is {}", *joint_count_));
      if (keyword_as_name) skip_line();
    }
    file_.joint_names = std::move(joint_names);
  }

  void read_effect(const Word& keyword) {
    const Word* name = read_one_name(keyword, "effect");
    if (name == nullptr) {
      skip_line();
      return;
    }
    EffectRow effect{std::string(name->text), name->position, {}};
    std::set<std::string_view> keys;
    while (!at_line_end() && (!at_keyword() || before_equals())) {
      const Word& word = take();
      if (std::optional<EffectRow::Setting> setting = read_setting(word)) {
        const std::string_view key = word.text.substr(0, setting->key.size());
        if (!keys.insert(key).second) {
          error(word, fmt::format("setting '{}' stands twice", printable(key)),
                "an effect has each setting once");
        }
        effect.settings.push_back(std::move(*setting));
      } else {
        skip_line();
      }
    }
    file_.effects.push_back(std::move(effect));
  }

  /// Whether the word after the next is a '=' that should not stand alone.
  [[nodiscard]] bool before_equals() const {
    return next_ + 1 < words_.size() && !words_[next_ + 1].begins_line &&
           words_[next_ + 1].text.front() == '=';
  }

  /// `key=value`; absent if it has another form, which is reported.
  std::optional<EffectRow::Setting> read_setting(const Word& word) {
    if (word.is_bad()) {
      report_bad_character(word, diagnostics_);
      return std::nullopt;
    }
    const std::size_t equals = word.text.find('=');
    const bool complete = equals != word.text.npos && equals + 1 < word.text.size();
    if (!complete || !is_identifier(word.text.substr(0, equals))) {
      error(word, fmt::format("expected a setting of the effect, found '{}'", printable(word.text)),
            "a setting is NAME=VALUE without blanks: vs=0.05");
      return std::nullopt;
    }
    ValueList list;
    const Word key = part_of(word, 0, equals);
    read_value(part_of(word, equals + 1, word.text.npos), printable(key.text), true, list);
    return EffectRow::Setting{std::string(key.text), key.position, std::move(list.values.front())};
  }

  void read_stop() {
    if (!has_next()) return;
    error(peek(), fmt::format("'{}' after 'stop'", printable(peek().text)),
          "only comments may follow 'stop'");
  }

  // --- the file as a whole

  void check_end() {
    const bool has_number_link = first_.contains(Statement::kNumberLink);
    if (!has_number_link && !joint_count_reported_ && !keyword_missed_) {
      diagnostics_.error(words_.empty() ? SourcePosition{1, 1} : words_.front().position, 1,
                         "the file has no row 'number_link'",
                         "begin with the number of joints: number_link 6");
    }
    for (const LetNames::Entry& entry : names_.all()) {
      if (entry.used) continue;
      diagnostics_.error(entry.position, static_cast<int>(entry.name.size()),
                         fmt::format("'{}' is declared and never used", printable(entry.name)),
                         "use it or delete its row");
    }
    if (words_.empty()) return;
    if (!first_.contains(Statement::kStop)) {
      diagnostics_.warning(end_of(words_.back()), 1, "the file ends without 'stop': is it cut off?",
                           "the last row is 'stop'");
    }
    const bool has_gravity = file_.row(RowKey::kGx).present || file_.row(RowKey::kGy).present ||
                             file_.row(RowKey::kGz).present;
    if (!has_gravity && !diagnostics_.has_errors()) {
      diagnostics_.warning(words_.back().position, words_.back().length,
                           "no row gx, gy or gz stands above: gravity is zero",
                           "write gz 9.81 if z points up, gz 0 if zero is meant");
    }
  }

  Diagnostics& diagnostics_;
  RobotFile file_;
  std::vector<Word> words_;  // views of file_.text
  std::size_t next_ = 0;
  LetNames names_;
  std::map<Statement, SourcePosition> first_;  // where each statement first stands
  std::optional<int> joint_count_;
  bool joint_count_reported_ = false;
  bool keyword_missed_ =
      false;  // a row was not understood: it may have been the one that is missing
};

}  // namespace

RobotFile read_rows(std::string text, std::string file_name, Diagnostics& diagnostics) {
  return RowReader(std::move(text), std::move(file_name), diagnostics).read();
}

}  // namespace dyngen
