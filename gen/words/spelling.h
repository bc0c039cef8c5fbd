// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace dyngen {

/// Letters, digits and '_', not beginning with a digit: a name that C accepts.
bool is_identifier(std::string_view word);

/// ASCII lower case; other bytes stay.
std::string lower_case(std::string_view word);

/// The candidate most likely meant by a misspelt word, in any case; empty if none is near enough.
///
/// Near means few insertions, deletions, substitutions and swaps of neighbours for the word's
/// length. The first of equally near candidates wins, so that a message never depends on anything
/// but the text.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> candidates);

/// "a, b, c", or "a, b, ... (12 in all)" where that gets long.
std::string comma_list(std::span<const std::string_view> words);

}  // namespace dyngen
