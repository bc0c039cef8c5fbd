// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "gen/diagnostic/diagnostic.h"

namespace dyngen {

/// What stands between blanks, commas, comments and line ends: a keyword, a name or a value.
///
/// A comma that separates nothing (at the start of a line, or after another comma) is a word of its
/// own, a bad one.
struct Word {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::string_view text;
  SourcePosition position;
  int length = 1;            ///< characters
  bool begins_line = false;  ///< nothing but blanks before it in its line
  bool after_comma = false;
  std::size_t bad = kNone;  ///< offset of the first character that no row may hold

  [[nodiscard]] bool is_bad() const { return bad != kNone; }
};

/// All words of a text, comments left out. The words are views of the text.
std::vector<Word> split_words(std::string_view text);

/// Reports the first bad character of a word: what it is, and what to write instead where that is
/// known.
void report_bad_character(const Word& word, Diagnostics& diagnostics);

/// A piece of a value.
enum class TokenKind {
  kNumber,     ///< 12, .5, 5., 1e-3
  kMalformed,  ///< began as a number and went wrong: 1.2.3, 1e+
  kName,
  kSymbol,  ///< one character: an operator, a parenthesis, or something that has no place in a
            ///< value
  kEnd,
};

struct Token {
  TokenKind kind = TokenKind::kEnd;
  std::string_view text;   ///< empty at the end
  std::size_t offset = 0;  ///< bytes from the start of the value
};

/// The pieces of a value, kEnd last.
std::vector<Token> split_tokens(std::string_view value);

}  // namespace dyngen
