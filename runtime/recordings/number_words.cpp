// SPDX-License-Identifier: MIT
#include "runtime/recordings/number_words.h"

#include <algorithm>
#include <array>

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

bool all_digits(std::string_view text) { return std::all_of(text.begin(), text.end(), is_digit); }

/// Blanks of all kinds and apostrophes between digits become one sign.
void unite_group_signs(std::string& word) {
  constexpr std::array<std::string_view, 5> kSigns = {" ", "\xC2\xA0", "\xE2\x80\xAF",
                                                      "\xE2\x80\x99", "\xA0"};
  for (const std::string_view sign : kSigns) {
    for (std::size_t at = word.find(sign); at != word.npos; at = word.find(sign, at + 1)) {
      word.replace(at, sign.size(), "'");
    }
  }
}

}  // namespace

bool means_missing(std::string_view word) {
  constexpr std::array<std::string_view, 16> kWords = {
      "",     "na",      "n/a",   "null",  "none",   "-",      "#n/a", "#na",
      "#nan", "#value!", "#num!", "#ref!", "#name?", "#null!", "#nv",  "#div/0!"};
  for (const std::string_view known : kWords) {
    if (word == known) return true;
  }
  return word == "nan" || word == "inf" || word == "infinity" || word.starts_with("nan(") ||
         word.starts_with("1.#") || word.starts_with("1,#");
}

bool use_decimal_sign(std::string& word, char decimal) {
  unite_group_signs(word);
  std::string_view text = word;
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const std::size_t exponent_at = std::min(text.find_first_of("ed"), text.size());
  std::string_view exponent = text.substr(exponent_at);
  if (!exponent.empty()) {
    exponent.remove_prefix(1);
    if (exponent.starts_with('+')) exponent.remove_prefix(1);
    const std::string_view digits = exponent.substr(exponent.starts_with('-') ? 1 : 0);
    if (digits.empty() || !all_digits(digits)) return false;
  }
  const std::string_view mantissa = text.substr(0, exponent_at);
  const std::size_t decimal_at = std::min(mantissa.find(decimal), mantissa.size());
  std::string_view fraction = mantissa.substr(decimal_at);
  if (!fraction.empty()) fraction.remove_prefix(1);
  std::string whole(mantissa.substr(0, decimal_at));
  if (!all_digits(fraction) || (whole.empty() && fraction.empty())) return false;
  if (!all_digits(whole)) {
    const char group = whole[std::min(whole.find_first_not_of("0123456789"), whole.size() - 1)];
    if ((group != '\'' && group != ',' && group != '.') || !is_grouped(whole, group)) return false;
    whole.erase(std::remove(whole.begin(), whole.end(), group), whole.end());
  }
  std::string plain = negative ? "-" : "";
  plain += whole.empty() ? "0" : whole;
  if (!fraction.empty()) plain.append(".").append(fraction);
  if (!exponent.empty()) plain.append("e").append(exponent);
  word = std::move(plain);
  return true;
}

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
