// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <string_view>

namespace dyngen {

/// One character of a text that may not be UTF-8 everywhere.
struct Utf8Character {
  char32_t code = 0;
  std::size_t size = 1;  ///< bytes; 1 for a byte that begins no valid sequence
  bool valid = true;
};

/// The character at byte `offset` < text.size(). Overlong forms, surrogates and codes past U+10FFFF
/// are not valid.
Utf8Character decode_utf8(std::string_view text, std::size_t offset);

/// How many characters a text has; a byte that is not UTF-8 counts as one.
int character_count(std::string_view text);

/// Whether a terminal shows the character as itself, in its place: no control characters, nothing
/// invisible, nothing that reorders its neighbours. A tab is not printable here; who prints lines
/// treats it apart.
bool is_printable(const Utf8Character& character);

}  // namespace dyngen
