// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/words/spelling.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "gen/words/characters.h"

namespace dyngen {

namespace {

constexpr std::size_t kLongestCorrected = 24;  // nobody misspells a keyword into a longer word
constexpr std::size_t kLongestList = 8;

/// Optimal string alignment distance: each swap of neighbours, insertion, deletion, substitution
/// costs 1.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> above(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) above[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, substitution});
      const bool swapped =
          i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && a[i - 1] != a[i - 2];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, above);
    std::swap(above, row);
  }
  return above[b.size()];
}

}  // namespace

bool is_identifier(std::string_view word) {
  return !word.empty() && is_letter(word.front()) &&
         std::all_of(word.begin(), word.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

std::string lower_case(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> candidates) {
  if (word.size() < 2 || word.size() > kLongestCorrected) return {};
  const std::string wanted = lower_case(word);
  std::string_view best;
  // Of two letters neither may change: every short name would be near every other.
  const bool letters_stay = word.size() == 2;
  std::size_t best_distance = 1 + std::max<std::size_t>(1, word.size() / 3);
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > kLongestCorrected) continue;
    const std::string other = lower_case(candidate);
    if (letters_stay &&
        !std::is_permutation(wanted.begin(), wanted.end(), other.begin(), other.end())) {
      continue;
    }
    const std::size_t distance = edit_distance(wanted, other);
    if (distance < best_distance && distance < candidate.size()) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string comma_list(std::span<const std::string_view> words) {
  if (words.size() <= kLongestList) return fmt::format("{}", fmt::join(words, ", "));
  return fmt::format("{}, ... ({} in all)", fmt::join(words.first(kLongestList), ", "),
                     words.size());
}

}  // namespace dyngen
