// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_file/name_rows.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <map>
#include <utility>

#include "gen/robot_file/expression.h"
#include "gen/robot_file/value_reader.h"
#include "gen/words/spelling.h"

namespace dyngen {

namespace {

bool check_name(RowWords& words, const Word& word, std::string_view row) {
  if (word.is_bad()) {
    report_bad_character(word, words.diagnostics());
    return false;
  }
  if (is_identifier(word.text)) return true;
  words.error(word, fmt::format("'{}' is not a name, in '{}'", printable(word.text), row),
              "a name is letters, digits and '_', and does not begin with a digit");
  return false;
}

/// A row of one word out of two.
struct ChoiceRow {
  std::string_view keyword;
  std::string_view what;  ///< the word names
  std::string_view expected;
};

template <typename Choice>
std::optional<Choice> read_choice(
    RowWords& words, const Word& keyword, const ChoiceRow& row,
    const std::array<std::pair<std::string_view, Choice>, 2>& choices) {
  if (words.at_line_end() || words.at_keyword()) {
    words.diagnostics().error(end_of(keyword), 1,
                              fmt::format("'{}' names no {}", row.keyword, row.what),
                              std::string(row.expected));
    return std::nullopt;
  }
  const Word& word = words.take();
  const std::string lower = lower_case(word.text);
  std::optional<Choice> choice;
  for (const auto& [name, value] : choices) {
    if (lower == name) choice = value;
  }
  if (!choice) {
    words.error(word,
                fmt::format("unknown {} '{}' in '{}'", row.what, printable(word.text), row.keyword),
                std::string(row.expected));
  }
  check_nothing_follows(words, row.keyword);
  return choice;
}

}  // namespace

const Word* read_one_name(RowWords& words, const Word& keyword, std::string_view row) {
  if (words.at_line_end()) {
    words.diagnostics().error(end_of(keyword), 1, fmt::format("expected a name after '{}'", row));
    return nullptr;
  }
  if (words.at_keyword()) {
    const Word& word = words.peek();
    words.error(word,
                fmt::format("the keyword '{}' is no name for '{}'", printable(word.text), row),
                "choose another name");
    const bool begins_row =
        words.after_next() != nullptr && starts_like_value(words.after_next()->text);
    if (!begins_row || row == "let") words.skip_line();
    return nullptr;
  }
  const Word& word = words.take();
  return check_name(words, word, row) ? &word : nullptr;
}

void check_nothing_follows(RowWords& words, std::string_view row) {
  if (words.at_line_end() || words.at_keyword()) return;
  words.error(words.peek(),
              fmt::format("unexpected '{}' after '{}'", printable(words.peek().text), row),
              fmt::format("'{}' takes one word", row));
  words.skip_line();
}

std::optional<DhConvention> read_dh_row(RowWords& words, const Word& keyword) {
  return read_choice<DhConvention>(
      words, keyword,
      {"dh", "convention", "expected modified (Khalil, Craig) or standard (distal)"},
      {{{"modified", DhConvention::kModified}, {"standard", DhConvention::kStandard}}});
}

std::optional<ParameterMeaning> read_parameters_row(RowWords& words, const Word& keyword) {
  return read_choice<ParameterMeaning>(
      words, keyword,
      {"parameters", "meaning", "expected bodies (of each link) or base (identified sums)"},
      {{{"bodies", ParameterMeaning::kBodies}, {"base", ParameterMeaning::kBase}}});
}

void read_let_row(RowWords& words, const Word& keyword) {
  const Word* name = read_one_name(words, keyword, "let");
  if (name == nullptr) {
    words.skip_line();
    return;
  }
  const bool builtin = is_builtin_name(name->text);
  if (builtin) {
    words.error(*name, fmt::format("'{}' is built in and cannot be declared", name->text),
                "choose another name");
  }
  ValueList list = read_values(words, *name, printable(name->text), 1, false);
  if (builtin) return;
  if (const LetNames::Entry* first = words.names().find(name->text)) {
    words.error(*name, fmt::format("'{}' is declared twice", printable(name->text)),
                fmt::format("the first is on line {}", first->position.line));
    return;
  }
  words.names().declare(name->text, name->position, std::move(list.last));
}

std::vector<std::string> read_joints_row(RowWords& words, const Word& keyword,
                                         std::optional<int> joint_count) {
  std::map<std::string_view, const Word*> first;
  std::vector<std::string> joint_names;
  const Word* last = &keyword;
  while (!words.at_line_end() && !words.at_keyword()) {
    last = &words.take();
    joint_names.emplace_back(last->text);
    if (!check_name(words, *last, "joints")) continue;
    const auto [place, is_first] = first.emplace(last->text, last);
    if (is_first) continue;
    words.error(*last, fmt::format("joint name '{}' stands twice", printable(last->text)),
                fmt::format("the first is in column {}", place->second->position.column));
  }
  if (joint_count && joint_names.size() != static_cast<std::size_t>(*joint_count)) {
    const bool keyword_as_name = words.at_keyword() && !words.peek().begins_line;
    words.diagnostics().error(
        end_of(*last), 1,
        fmt::format("expected {} in 'joints', found {}",
                    plural(static_cast<std::size_t>(*joint_count), "name"), joint_names.size()),
        keyword_as_name
            ? fmt::format("the keyword '{}' cannot name a joint", printable(words.peek().text))
            : fmt::format("number_link is {}", *joint_count));
    if (keyword_as_name) words.skip_line();
  }
  return joint_names;
}

}  // namespace dyngen
