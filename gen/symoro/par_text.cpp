// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/symoro/par_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "gen/diagnostic/line_table.h"
#include "gen/diagnostic/utf8.h"
#include "gen/words/characters.h"

namespace dyngen {

namespace {

constexpr std::string_view kParBlanks = " \t\r\n";

class ParScanner {
 public:
  ParScanner(std::string_view text, Diagnostics& diagnostics)
      : original_(text), text_(text), lines_(text), diagnostics_(diagnostics) {}

  std::vector<ParAssignment> read(std::string& robot_name) {
    blank_comments(robot_name);
    std::vector<ParAssignment> result;
    while (true) {
      at_ = text_.find_first_not_of(" \t\r\n;", at_);
      if (at_ == text_.npos || diagnostics_.full()) return result;
      if (std::optional<ParAssignment> own = assignment()) result.push_back(std::move(*own));
    }
  }

 private:
  void error(std::size_t byte, std::size_t size, const std::string& message,
             const std::string& hint) {
    const int length = character_count(std::string_view(original_).substr(byte, size));
    diagnostics_.error(lines_.position_of(original_, byte), std::max(1, length), message, hint);
  }

  /// Comments become blanks, so that bytes keep their places.
  void blank_comments(std::string& robot_name) {
    std::size_t begin = 0;
    while ((begin = text_.find("(*", begin)) != text_.npos) {
      std::size_t end = text_.find("*)", begin + 2);
      if (end == text_.npos) {
        error(begin, 2, "the comment '(*' does not end", "expected *)");
        end = text_.size() - 2;
      }
      const std::string_view comment = std::string_view(original_).substr(begin, end - begin);
      if (comment.find("Robotname") != comment.npos) {
        const std::size_t open = comment.find('\''), close = comment.rfind('\'');
        if (open != comment.npos && close > open) {
          robot_name = comment.substr(open + 1, close - open - 1);
        }
      }
      for (std::size_t i = begin; i < end + 2; ++i) {
        if (text_[i] != '\n') text_[i] = ' ';
      }
    }
  }

  std::optional<ParAssignment> assignment() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::size_t equals = text_.find_first_not_of(kParBlanks, at_);
    if (at_ == begin || equals == text_.npos || text_[equals] != '=') {
      const std::size_t end = std::min(text_.find('\n', begin), text_.size());
      error(begin, std::max<std::size_t>(at_ - begin, 1),
            fmt::format("expected NAME = ..., found '{}'",
                        printable(std::string_view(text_).substr(begin, end - begin))),
            "a SYMORO file is a list of assignments: NL = 6, d = {0, 0, D3}");
      at_ = end;
      return std::nullopt;
    }
    ParAssignment own;
    own.name = text_.substr(begin, at_ - begin);
    own.position = lines_.position_of(original_, begin);
    at_ = text_.find_first_not_of(kParBlanks, equals + 1);
    if (at_ == text_.npos) {
      error(equals, 1, fmt::format("nothing follows '{} ='", own.name), "expected a value");
      return std::nullopt;
    }
    own.list = text_[at_] == '{';
    if (!own.list) {
      const std::size_t end = std::min(text_.find_first_of("\n;", at_), text_.size());
      own.values.push_back(value(at_, end));
      at_ = end;
      return own;
    }
    const std::size_t close = text_.find('}', at_);
    if (close == text_.npos) {
      error(at_, 1, fmt::format("the list of '{}' does not end", own.name), "expected }");
      at_ = text_.size();
      return std::nullopt;
    }
    std::size_t from = at_ + 1;
    for (std::size_t i = from; i <= close; ++i) {
      if (text_[i] != ',' && i != close) continue;
      own.values.push_back(value(from, i));
      from = i + 1;
    }
    at_ = close + 1;
    return own;
  }

  [[nodiscard]] ParValue value(std::size_t begin, std::size_t end) const {
    const std::size_t first = std::min(text_.find_first_not_of(kParBlanks, begin), end);
    std::size_t last = end;
    while (last > first && kParBlanks.find(text_[last - 1]) != kParBlanks.npos) --last;
    ParValue own;
    own.position = lines_.position_of(original_, first);
    own.length = std::max(1, character_count(original_.substr(first, last - first)));
    for (const char c : text_.substr(first, last - first)) {
      if (kParBlanks.find(c) == kParBlanks.npos) own.text += c;
    }
    return own;
  }

  std::string_view original_;
  std::string text_;
  LineTable lines_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<ParAssignment> read_assignments(std::string_view text, Diagnostics& diagnostics,
                                            std::string& robot_name) {
  return ParScanner(text, diagnostics).read(robot_name);
}

}  // namespace dyngen
