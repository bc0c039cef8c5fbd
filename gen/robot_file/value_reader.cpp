// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_file/value_reader.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <utility>

#include "gen/robot_file/expression.h"
#include "gen/robot_file/keywords.h"
#include "gen/words/spelling.h"

namespace dyngen {

namespace {

bool takes_joint_count(std::string_view row) {
  const Keyword* keyword = find_keyword(row);
  return keyword != nullptr && keyword->statement == Statement::kValues && !is_scalar(keyword->row);
}

/// Whether the next word belongs to the row being read. After the last value, a name that is not
/// a value's is left to be reported as an unknown keyword: rows may share a line.
bool at_value(const RowWords& words, bool complete) {
  if (!words.has_next() || words.at_keyword()) return false;
  const Word& word = words.peek();
  if (word.begins_line) return starts_like_value(word.text);
  return !complete || !is_identifier(word.text) || begins_with_known_name(word.text, words.names());
}

}  // namespace

ValueList read_values(RowWords& words, const Word& keyword, std::string_view row,
                      std::optional<int> expected, bool unknown_allowed) {
  ValueList list;
  std::size_t found = 0;
  const auto wanted = static_cast<std::size_t>(expected.value_or(0));
  const Word* last = &keyword;
  const Word* surplus = nullptr;
  bool commas = false;
  bool signs = false;
  while (at_value(words, expected && found >= wanted)) {
    const Word& word = words.take();
    ++found;
    commas = commas || word.after_comma;
    signs = signs || (found > 1 && (word.text.front() == '+' || word.text.front() == '-'));
    if (found == 1 && word.after_comma) {
      words.error(word, fmt::format("no value before ',' in '{}'", row), "delete the ','");
    }
    if (expected && found > wanted) {
      if (surplus == nullptr) surplus = &word;
    } else {
      last = &word;
      read_value(words, word, row, unknown_allowed, list);
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
    words.error(*surplus, message, hint);
  } else if (words.has_next() && words.peek().begins_line &&
             begins_with_known_name(words.peek().text, words.names())) {
    words.error(words.peek(),
                fmt::format("'{}' cannot continue row '{}'", printable(words.peek().text), row),
                "a line that continues a row begins with a digit or one of . + - ( *");
    words.take();
    words.skip_line();
  } else {
    words.diagnostics().error(end_of(*last), 1, message, hint);
  }
  return list;
}

void read_value(RowWords& words, const Word& word, std::string_view row, bool unknown_allowed,
                ValueList& list) {
  const Keyword* keyword = find_keyword(row);
  const bool of_values = keyword != nullptr && keyword->statement == Statement::kValues;
  const bool of_limits = of_values && is_limit(keyword->row);
  const bool two_forms = of_values && has_other_form(keyword->row);
  list.values.push_back({true, 0, word.position, word.length, std::string(word.text)});
  list.last.reset();
  if (list.damaged) return;  // the pieces of one value need no message each
  if (word.is_bad()) {
    report_bad_character(word, words.diagnostics());
    list.damaged = true;
  } else if (word.text == "*") {
    if (unknown_allowed) return;
    words.error(
        word, fmt::format("'*' (unknown) cannot stand in '{}'", row),
        of_limits
            ? "write - for a joint without a limit"
            : "it can stand in m mX mY mZ XX XY XZ YY YZ ZZ cX .. IZZ IA Fs Fv off d r gx gy gz");
  } else if (word.text == "-" && (of_limits || two_forms)) {
    return;  // no limit, or the link has the other form
  } else {
    Evaluation evaluation = evaluate(word, row, words.names(), words.diagnostics());
    list.damaged = evaluation.cut_off;
    if (!evaluation.number) return;
    list.values.back().unknown = false;
    list.values.back().value = evaluation.number->exact();
    list.last = std::move(evaluation.number);
  }
}

}  // namespace dyngen
