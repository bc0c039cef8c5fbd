// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gen/diagnostic/diagnostic.h"
#include "gen/robot_file/expression.h"
#include "gen/robot_file/lexer.h"

namespace dyngen {

/// The words of a robot file, taken one after the other, and what the readers of all rows share:
/// the names of `let` rows, and where mistakes are reported.
class RowWords {
 public:
  /// @param text  outlives this object, whose words are views of it
  RowWords(std::string_view text, Diagnostics& diagnostics);

  [[nodiscard]] bool has_next() const { return next_ < words_.size(); }
  [[nodiscard]] const Word& peek() const { return words_[next_]; }
  /// The word behind the next one if it stands on the same line, or null.
  [[nodiscard]] const Word* after_next() const;
  [[nodiscard]] const Word& last_taken() const { return words_[next_ - 1]; }
  [[nodiscard]] std::span<const Word> all() const { return words_; }
  [[nodiscard]] std::span<const Word> rest() const { return std::span(words_).subspan(next_); }
  [[nodiscard]] bool at_line_end() const { return !has_next() || peek().begins_line; }
  [[nodiscard]] bool at_keyword() const;

  /// Counts the `let` names in the word as used.
  const Word& take();
  void skip_line();

  void error(const Word& word, const std::string& message, const std::string& hint = {});
  [[nodiscard]] Diagnostics& diagnostics() { return diagnostics_; }
  [[nodiscard]] LetNames& names() { return names_; }
  [[nodiscard]] const LetNames& names() const { return names_; }

 private:
  Diagnostics& diagnostics_;
  std::vector<Word> words_;
  std::size_t next_ = 0;
  LetNames names_;
};

/// Whether a word that begins a line continues the row above: what Appendix B's reader takes for a
/// number.
bool starts_like_value(std::string_view word);

/// "1 value", "2 values".
std::string plural(std::size_t count, std::string_view noun);

SourcePosition end_of(const Word& word);

}  // namespace dyngen
