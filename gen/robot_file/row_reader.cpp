// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_file/row_reader.h"

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "gen/robot_file/effect_row_reader.h"
#include "gen/robot_file/expression.h"
#include "gen/robot_file/keywords.h"
#include "gen/robot_file/name_rows.h"
#include "gen/robot_file/row_words.h"
#include "gen/robot_file/value_reader.h"
#include "gen/words/spelling.h"

namespace dyngen {

namespace {

/// A C identifier made of a file's stem: "6dof-arm.v2" gives r6dof_arm_v2.
std::string name_from_stem(const std::string& file_name) {
  std::string name = std::filesystem::path(file_name).stem().string();
  for (char& c : name) {
    if (!is_identifier(std::string("_") + c)) c = '_';
  }
  if (name.empty()) return "robot";
  return is_identifier(name) ? name : "r" + name;
}

RobotFile unread_file(std::string text, std::string file_name) {
  RobotFile file;
  file.file_name = std::move(file_name);
  file.text = std::move(text);
  file.source_text = file.text;
  return file;
}

class RowReader {
 public:
  RowReader(std::string text, std::string file_name, Diagnostics& diagnostics)
      : file_(unread_file(std::move(text), std::move(file_name))),
        words_(file_.text, diagnostics) {}

  RobotFile read() {
    while (words_.has_next() && !first_.contains(Statement::kStop)) read_row();
    check_end();
    if (file_.name.empty()) file_.name = name_from_stem(file_.file_name);
    return std::move(file_);
  }

 private:
  void read_row() {
    const Word& word = words_.take();
    const Keyword* keyword = find_keyword(word.text);
    if (keyword == nullptr) {
      report_no_keyword(word);
      skip_unknown_row();
      return;
    }
    read_row(word, *keyword);
    file_.texts.push_back({keyword->statement, keyword->row, begin_of(word),
                           begin_of(words_.last_taken()) + words_.last_taken().text.size()});
  }

  /// Bytes from the start of the text.
  [[nodiscard]] std::size_t begin_of(const Word& word) const {
    return static_cast<std::size_t>(word.text.data() - file_.text.data());
  }

  void read_row(const Word& word, const Keyword& keyword) {
    if (keyword.statement == Statement::kValues) {
      read_value_row(word, keyword);
      return;
    }
    const bool may_repeat =
        keyword.statement == Statement::kLet || keyword.statement == Statement::kEffect;
    if (!may_repeat) check_first(word, keyword.spelling, keyword.statement);
    switch (keyword.statement) {
      case Statement::kName:
        return read_name(word);
      case Statement::kNumberLink:
        return read_number_link(word);
      case Statement::kDh:
        file_.convention = read_dh_row(words_, word).value_or(file_.convention);
        return;
      case Statement::kParameters:
        file_.parameters = read_parameters_row(words_, word).value_or(file_.parameters);
        return;
      case Statement::kLet:
        return read_let_row(words_, word);
      case Statement::kJoints:
        require_joint_count(word);
        file_.joint_names = read_joints_row(words_, word, joint_count_);
        return;
      case Statement::kEffect:
        if (std::optional<EffectRow> effect = read_effect_row(words_, word)) {
          file_.effects.push_back(std::move(*effect));
        }
        return;
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
    words_.error(word, fmt::format("row '{}' stands twice", spelling),
                 fmt::format("the first is on line {}", first.line));
  }

  void report_no_keyword(const Word& word) {
    keyword_missed_ = true;
    const std::string shown = printable(word.text);
    if (word.is_bad()) {
      report_bad_character(word, words_.diagnostics());
    } else if (starts_like_value(word.text) || begins_with_known_name(word.text, words_.names())) {
      words_.error(word, fmt::format("expected a keyword, found '{}'", shown),
                   "a value follows its keyword: d 0 0.5 0");
    } else if (word.text.find('=') != word.text.npos) {
      words_.error(word, fmt::format("expected a keyword, found '{}'", shown),
                   "settings stand on the line of their effect");
    } else {
      words_.error(word, fmt::format("unknown keyword '{}'", shown), keyword_hint(word.text));
    }
  }

  /// To the next line that is not a continuation, or to a keyword that follows a value, as where
  /// rows share a line. (A keyword that follows a word is more likely prose: "the d of link 3".)
  void skip_unknown_row() {
    bool after_value = false;
    while (words_.has_next()) {
      const Word& word = words_.peek();
      if (word.begins_line && !starts_like_value(word.text)) return;
      if (after_value && words_.at_keyword()) return;
      after_value = starts_like_value(word.text);
      words_.take();
    }
  }

  void read_value_row(const Word& word, const Keyword& keyword) {
    const bool scalar = is_scalar(keyword.row);
    if (!scalar) require_joint_count(word);
    ValueList list = read_values(words_, word, keyword.spelling, scalar ? 1 : joint_count_,
                                 may_be_unknown(keyword.row));
    Row& row = file_.rows[static_cast<std::size_t>(keyword.row)];
    if (row.present) {
      report_duplicate(word, keyword.spelling, row.keyword);
      return;
    }
    row = {true, word.position, std::move(list.values)};
  }

  void require_joint_count(const Word& word) {
    if (first_.contains(Statement::kNumberLink) || joint_count_reported_) return;
    joint_count_reported_ = true;
    for (const Word& other : words_.rest()) {
      const Keyword* later = find_keyword(other.text);
      if (later == nullptr || later->statement != Statement::kNumberLink) continue;
      words_.error(word, fmt::format("'{}' stands before number_link", printable(word.text)),
                   fmt::format("move number_link up from line {}", other.position.line));
      return;
    }
    if (keyword_missed_) return;
    words_.error(word, fmt::format("'{}' stands before number_link", printable(word.text)),
                 "begin with the number of joints: number_link 6");
  }

  void read_number_link(const Word& word) {
    const ValueList list = read_values(words_, word, "number_link", 1, false);
    if (list.values.empty() || list.values.front().unknown || joint_count_) return;
    const FieldValue& value = list.values.front();
    const bool in_range = value.value.info(GiNaC::info_flags::integer) && value.value >= 1 &&
                          value.value <= kMaxJoints;
    if (!in_range) {
      words_.diagnostics().error(value.position, value.length,
                                 fmt::format("number_link is {}", printable(value.text)),
                                 fmt::format("expected an integer from 1 to {}", kMaxJoints));
      return;
    }
    joint_count_ = GiNaC::ex_to<GiNaC::numeric>(value.value).to_int();
    file_.joint_count = *joint_count_;
  }

  void read_name(const Word& keyword) {
    const Word* word = read_one_name(words_, keyword, "name");
    if (word != nullptr) file_.name = word->text;
    check_nothing_follows(words_, "name");
  }

  void read_stop() {
    if (!words_.has_next()) return;
    words_.error(words_.peek(), fmt::format("'{}' after 'stop'", printable(words_.peek().text)),
                 "only comments may follow 'stop'");
  }

  /// What is wrong with the file as a whole.
  void check_end() {
    const std::span<const Word> all = words_.all();
    const bool has_number_link = first_.contains(Statement::kNumberLink);
    if (!has_number_link && !joint_count_reported_ && !keyword_missed_) {
      words_.diagnostics().error(all.empty() ? SourcePosition{1, 1} : all.front().position, 1,
                                 "the file has no row 'number_link'",
                                 "begin with the number of joints: number_link 6");
    }
    for (const LetNames::Entry& entry : words_.names().all()) {
      if (entry.used) continue;
      words_.diagnostics().error(
          entry.position, static_cast<int>(entry.name.size()),
          fmt::format("'{}' is declared and never used", printable(entry.name)),
          "use it or delete its row");
    }
    if (all.empty()) return;
    file_.last_word = all.back().position;
    if (!first_.contains(Statement::kStop)) {
      words_.diagnostics().warning(end_of(all.back()), 1,
                                   "the file ends without 'stop': is it cut off?",
                                   "the last row is 'stop'");
    }
    const bool has_gravity = file_.row(RowKey::kGx).present || file_.row(RowKey::kGy).present ||
                             file_.row(RowKey::kGz).present;
    if (!has_gravity && !words_.diagnostics().has_errors()) {
      words_.diagnostics().warning(all.back().position, all.back().length,
                                   "no row gx, gy or gz stands above: gravity is zero",
                                   "write gz 9.81 if z points up, gz 0 if zero is meant");
    }
  }

  RobotFile file_;
  RowWords words_;                             // views of file_.text
  std::map<Statement, SourcePosition> first_;  // where each statement first stands
  std::optional<int> joint_count_;
  bool joint_count_reported_ = false;
  // a row was not understood: it may have been the one that is missing
  bool keyword_missed_ = false;
};

}  // namespace

RobotFile read_rows(std::string text, std::string file_name, Diagnostics& diagnostics) {
  return RowReader(std::move(text), std::move(file_name), diagnostics).read();
}

}  // namespace dyngen
