// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/robot_text.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string_view>

#include "gen/robot_file/lexer.h"

namespace dyngen::runtime {
namespace {

/// Bytes [begin, end) of the original that become other ones.
struct Replacement {
  std::size_t begin = 0, end = 0;
  std::string text;
};

/// The end of a row that is taken out: a comma behind its last value goes with it.
std::size_t end_of_row(const RobotFile& file, const RowText& row) {
  const std::size_t next = file.text.find_first_not_of(" \t", row.end);
  return next != std::string::npos && file.text[next] == ',' ? next + 1 : row.end;
}

std::string_view words_of_row(const RobotFile& file, const RowText& row) {
  return std::string_view(file.text).substr(row.begin, row.end - row.begin);
}

/// All names in a piece of the text.
void add_names(std::string_view text, std::set<std::string, std::less<>>& names) {
  for (const Word& word : split_words(text)) {
    for (const Token& token : split_tokens(word.text)) {
      if (token.kind == TokenKind::kName) names.emplace(token.text);
    }
  }
}

/// Which rows go: those that are asked for, and `let` rows of which nothing is left to speak. A
/// `let` row may use those above it alone, so that one way up is enough.
std::vector<bool> rows_that_go(const RobotFile& file, const RobotTextChange& change) {
  const std::size_t count = file.texts.size();
  std::vector<bool> goes(count, false);
  std::set<std::string, std::less<>> used;
  for (std::size_t i = count; i-- > 0;) {
    const RowText& row = file.texts[i];
    if (row.statement == Statement::kLet) {
      const std::string_view name = split_words(words_of_row(file, row))[1].text;
      goes[i] = !used.contains(name);
    } else {
      goes[i] = change.removed && change.removed(row);
    }
    const bool rewritten = row.statement == Statement::kEffect && !change.effects.empty();
    if (!goes[i] && !rewritten) add_names(words_of_row(file, row), used);
  }
  return goes;
}

bool only_blanks(std::string_view text) {
  return text.find_first_not_of(" \t\r,") == std::string_view::npos;
}

/// Nothing but blanks and a comment.
bool says_nothing(std::string_view line) {
  return only_blanks(line.substr(0, std::min(line.size(), line.find_first_of("#;"))));
}

/// Copies a text, and drops the lines of which only a comment is left.
class LineWriter {
 public:
  /// @param kept  bytes of the original that stay as they are
  void keep(std::string_view kept) {
    for (const char c : kept) {
      if (c == '\n') {
        end_line();
      } else {
        line_ += c;
      }
    }
  }
  void take_out(std::string_view text) {
    changed_ = true;
    for (const char c : text) {
      if (c != '\n') continue;
      end_line();
      changed_ = true;
    }
  }
  void put_in(const std::string& text) { line_ += text; }
  /// Whole lines, behind what the line holds already.
  void add_lines(const std::vector<std::string>& lines) {
    const bool begun = !only_blanks(line_);
    const bool changed = changed_;
    if (begun) end_line();
    line_.clear();
    for (const std::string& line : lines) text_ += line + "\n";
    changed_ = changed || begun;
  }
  std::string finish() {
    if (!line_.empty()) end_line();
    return std::move(text_);
  }

 private:
  void end_line() {
    if (!line_.empty() && line_.back() == '\r') line_.pop_back();
    const bool left_over = changed_ && says_nothing(line_);
    if (!left_over) text_ += line_ + "\n";
    line_.clear();
    changed_ = false;
  }

  std::string text_, line_;
  bool changed_ = false;  // something was taken out of the line
};

}  // namespace

std::string changed_text(const RobotFile& file, const RobotTextChange& change) {
  if (!change.effects.empty() && change.effects.size() != file.effects.size()) {
    throw std::logic_error("changed_text(): other effects than the file has");
  }
  const std::vector<bool> goes = rows_that_go(file, change);
  std::vector<Replacement> replacements;
  std::size_t place = file.text.size();  // of the added lines
  bool any = false;
  std::size_t effect = 0;
  for (std::size_t i = 0; i < file.texts.size(); ++i) {
    const RowText& row = file.texts[i];
    if (goes[i]) {
      replacements.push_back({row.begin, end_of_row(file, row), {}});
      if (row.statement == Statement::kValues) {
        place = replacements.back().end;
        any = true;
      }
    } else if (row.statement == Statement::kEffect && !change.effects.empty()) {
      replacements.push_back({row.begin, row.end, change.effects[effect++]});
    } else if (row.statement == Statement::kStop && !any) {
      place = row.begin;
    }
  }
  const std::string_view text = file.text;
  LineWriter writer;
  std::size_t at = 0;
  bool added = change.added.empty();
  const auto keep_to = [&](std::size_t end) {
    if (!added && place <= end) {
      writer.keep(text.substr(at, place - at));
      writer.add_lines(change.added);
      at = place;
      added = true;
    }
    writer.keep(text.substr(at, end - at));
    at = end;
  };
  for (const Replacement& own : replacements) {
    keep_to(own.begin);
    if (own.text.empty()) {
      writer.take_out(text.substr(own.begin, own.end - own.begin));
    } else {
      writer.put_in(own.text);
    }
    at = own.end;
  }
  keep_to(text.size());
  return writer.finish();
}

}  // namespace dyngen::runtime
