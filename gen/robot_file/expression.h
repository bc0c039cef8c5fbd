// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gen/diagnostic/diagnostic.h"
#include "gen/robot_file/exact_number.h"
#include "gen/robot_file/lexer.h"

namespace dyngen {

/// What `let` rows have declared so far.
class LetNames {
 public:
  struct Entry {
    std::string name;
    SourcePosition position;
    std::optional<ExactNumber> value;  ///< absent if the row is wrong, which its own message says
    bool used = false;
  };

  /// Adds a name; false if it stands already.
  bool declare(std::string_view name, SourcePosition position, std::optional<ExactNumber> value);

  /// Says that the text has a `let` row for this name, perhaps further down: for messages only.
  void announce(std::string_view name, SourcePosition position);

  [[nodiscard]] const Entry* find(std::string_view name) const;
  [[nodiscard]] std::optional<SourcePosition> announced(std::string_view name) const;
  [[nodiscard]] const std::vector<Entry>& all() const { return entries_; }

  /// Counts every declared name in a value as used, also where the value is not evaluated.
  void mark_used(std::string_view value);

 private:
  std::vector<Entry> entries_;  // in the order of the file
  std::map<std::string, std::size_t, std::less<>> places_;
  std::map<std::string, SourcePosition, std::less<>> announced_;
};

/// pi, deg, sqrt, sin, cos, in any case: a name that `let` may not take.
bool is_builtin_name(std::string_view word);

/// Whether a value begins with a builtin or a declared name: then it is no misspelt keyword.
bool begins_with_known_name(std::string_view value, const LetNames& names);

struct Evaluation {
  std::optional<ExactNumber> number;  ///< absent if the value is wrong, which is reported
  bool cut_off = false;  ///< wrong as a piece of a value is that holds blanks: `pi`, `/`, `2`
};

/// Works out a value: numbers, pi, deg, let names, + - * / ^ ( ), sqrt, sin, cos.
///
/// @param word  without bad characters     @param row  the keyword, for messages
Evaluation evaluate(const Word& word, std::string_view row, const LetNames& names,
                    Diagnostics& diagnostics);

}  // namespace dyngen
