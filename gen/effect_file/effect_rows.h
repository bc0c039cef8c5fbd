// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gen/diagnostic/diagnostic.h"
#include "gen/effect_file/effect_expression.h"

namespace dyngen {

/// A keyword and what follows it, on its line and on lines that begin with a blank.
struct EffectRowText {
  std::string keyword;
  SourcePosition position;
  std::vector<EffectText> pieces;  ///< without comments; one a line
};

/// Splits a text into rows.
std::vector<EffectRowText> split_effect_rows(const std::string& text, Diagnostics& diagnostics);

/// Goes through a row word by word.
class EffectRowCursor {
 public:
  explicit EffectRowCursor(const EffectRowText& row) : pieces_(row.pieces), end_(row.position) {}

  /// The next word, up to a blank or ':'; none at the end.
  std::optional<EffectText> word();
  /// Takes a ':' if it is next.
  bool colon();
  /// What is left up to the next ':' that stands outside of words, or to the end.
  std::vector<EffectText> until_colon();
  /// All that is left.
  std::vector<EffectText> rest();
  [[nodiscard]] bool at_end();
  /// Where something is missing.
  [[nodiscard]] SourcePosition place();

 private:
  void skip_blanks();

  std::vector<EffectText> pieces_;
  SourcePosition end_;
  std::size_t piece_ = 0;
  std::size_t offset_ = 0;
};

/// Pieces as one line of text.
std::string joined_text(const std::vector<EffectText>& pieces);

}  // namespace dyngen
