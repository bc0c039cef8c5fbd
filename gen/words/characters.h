// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace dyngen {

/// Characters of words, whatever the locale.
constexpr bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace dyngen
