// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/evaluate/state_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "gen/diagnostic/diagnostic.h"
#include "gen/robot_file/expression.h"
#include "gen/robot_file/lexer.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

constexpr const char* kOption = "--eval";

/// name=value,value
struct Assigned {
  std::string name;
  SourcePosition position;
  std::vector<GiNaC::ex> values;
};

/// Length of NAME in "NAME=rest"; 0 if the word does not begin so.
std::size_t name_length(std::string_view word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string_view::npos || equals == 0) return 0;
  const bool name = std::all_of(word.begin(), word.begin() + static_cast<long>(equals), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  });
  return name && std::isdigit(static_cast<unsigned char>(word[0])) == 0 ? equals : 0;
}

/// The word without its first characters, all of which are ASCII.
Word without_first(Word word, std::size_t count) {
  word.text.remove_prefix(count);
  word.position.column += static_cast<int>(count);
  word.length -= static_cast<int>(count);
  if (word.is_bad()) word.bad -= std::min(word.bad, count);
  return word;
}

void add_value(const Word& word, Assigned& to, Diagnostics& diagnostics) {
  if (word.is_bad()) {
    report_bad_character(word, diagnostics);
    return;
  }
  const Evaluation evaluation = evaluate(word, to.name, LetNames(), diagnostics);
  to.values.push_back(evaluation.number ? evaluation.number->exact() : GiNaC::ex(0));
}

std::vector<Assigned> read_assigned(const std::string& text, Diagnostics& diagnostics) {
  std::vector<Assigned> all;
  for (const Word& word : split_words(text)) {
    const std::size_t length = name_length(word.text);
    if (length > 0) {
      all.push_back({std::string(word.text.substr(0, length)), word.position, {}});
      const Word rest = without_first(word, length + 1);
      if (!rest.text.empty()) add_value(rest, all.back(), diagnostics);
    } else if (all.empty()) {
      diagnostics.error(word.position, word.length,
                        fmt::format("'{}' belongs to no name", printable(word.text)),
                        "expected q=VALUE,... dq=VALUE,... ddq=VALUE,...");
    } else {
      add_value(word, all.back(), diagnostics);
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (all[k].name != all[i].name) continue;
      diagnostics.error(all[i].position, static_cast<int>(all[i].name.size()),
                        fmt::format("'{}' stands twice", all[i].name), "expected it once");
    }
  }
  return all;
}

std::string joint_list(const RobotModel& model) {
  std::string names;
  for (const JointModel& joint : model.joints) {
    if (joint.coordinate >= 0) names += (names.empty() ? "" : " ") + joint.name;
  }
  return names;
}

void take_motion(const Assigned& from, const RobotModel& model, std::vector<double>& to,
                 Diagnostics& diagnostics) {
  const auto expected = static_cast<std::size_t>(model.coordinate_count);
  if (from.values.size() != expected) {
    diagnostics.error(from.position, static_cast<int>(from.name.size()),
                      fmt::format("'{}' has {} {}", from.name, from.values.size(),
                                  from.values.size() == 1 ? "value" : "values"),
                      fmt::format("expected {}, one for each moving joint of {}: {}", expected,
                                  model.name, joint_list(model)));
    return;
  }
  to.clear();
  for (const GiNaC::ex& value : from.values) to.push_back(to_double(value));
}

/// All words in one line, without blanks beside '='.
std::string joined_words(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    for (char c : word + " ") {
      if (c == '\n' || c == '\r' || c == '\t') c = ' ';
      if (c == ' ' && (text.empty() || text.back() == ' ' || text.back() == '=')) continue;
      if (c == '=' && !text.empty() && text.back() == ' ') text.pop_back();
      text += c;
    }
  }
  if (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

StateRequest read_state(const std::vector<std::string>& words, const RobotModel& model) {
  const std::string text = joined_words(words);
  Diagnostics diagnostics(kOption, text);
  const std::vector<Assigned> all = read_assigned(text, diagnostics);
  StateRequest request;
  request.dq.assign(static_cast<std::size_t>(model.coordinate_count), 0.0);
  request.q = request.ddq = request.dq;
  bool has_q = false;
  if (!diagnostics.has_errors()) {
    for (const Assigned& entry : all) {
      if (entry.name == "q" || entry.name == "dq" || entry.name == "ddq") {
        has_q = has_q || entry.name == "q";
        take_motion(entry, model,
                    entry.name == "q"    ? request.q
                    : entry.name == "dq" ? request.dq
                                         : request.ddq,
                    diagnostics);
      } else if (entry.values.size() != 1) {
        diagnostics.error(entry.position, static_cast<int>(entry.name.size()),
                          fmt::format("'{}' has {} values", entry.name, entry.values.size()),
                          "expected one");
      } else {
        request.given.push_back({entry.name, entry.values[0]});
      }
    }
  }
  if (diagnostics.has_errors()) {
    std::string message = diagnostics.render();
    while (!message.empty() && message.back() == '\n') message.pop_back();
    throw std::invalid_argument(message);
  }
  if (!has_q) {
    throw std::invalid_argument(
        fmt::format("{}: q is missing; expected q=VALUE,... with {} values, one for each moving "
                    "joint of {}: {}",
                    kOption, model.coordinate_count, model.name, joint_list(model)));
  }
  return request;
}

}  // namespace dyngen
