// SPDX-License-Identifier: MIT
#include "runtime/recordings/number_words.h"

#include <algorithm>

namespace dyngen::runtime {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// "1,234,567": one to three digits, then groups of three, each after `sign`.
bool is_grouped(std::string_view digits, char sign) {
  const std::size_t first = digits.find(sign);
  if (first == digits.npos || first < 1 || first > 3 || digits.front() == '0') return false;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const bool sign_wanted = i >= first && (i - first) % 4 == 0;
    if (sign_wanted ? digits[i] != sign : !is_digit(digits[i])) return false;
  }
  return (digits.size() - first) % 4 == 0;
}

}  // namespace

NumberStyle use_decimal_point(std::string& word, std::string_view line) {
  const auto commas = std::count(word.begin(), word.end(), ',');
  const auto points = std::count(word.begin(), word.end(), '.');
  if (commas == 0 && points <= 1) return NumberStyle::kPlain;
  const std::size_t begin = !word.empty() && (word[0] == '-' || word[0] == '+') ? 1 : 0;
  const std::size_t end = std::min(word.find('e'), word.size());
  const std::string_view digits = std::string_view(word).substr(begin, end - begin);

  if (commas == 1 && points == 0) {
    const bool other_points = line.find('.') != line.npos;
    if (other_points && is_grouped(digits, ',')) return NumberStyle::kAmbiguous;
    std::replace(word.begin(), word.end(), ',', '.');
    return NumberStyle::kPlain;
  }
  const bool comma_is_decimal = commas == 1 && digits.rfind(',') > digits.rfind('.');
  const bool point_is_decimal = points == 1 && digits.rfind('.') > digits.rfind(',');
  const char group = comma_is_decimal ? '.' : point_is_decimal || points == 0 ? ',' : '.';
  const bool has_decimals = comma_is_decimal || point_is_decimal;
  const std::size_t whole =
      has_decimals ? digits.rfind(comma_is_decimal ? ',' : '.') : digits.size();
  if (!is_grouped(digits.substr(0, whole), group)) return NumberStyle::kNone;
  word.erase(std::remove(word.begin(), word.end(), group), word.end());
  std::replace(word.begin(), word.end(), ',', '.');
  return NumberStyle::kPlain;
}

}  // namespace dyngen::runtime
