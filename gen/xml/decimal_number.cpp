// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/xml/decimal_number.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace dyngen {

namespace {

constexpr std::string_view kXmlBlanks = " \t\r\n";

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kXmlBlanks);
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(kXmlBlanks) - begin + 1);
}

bool is_spelt_as_decimal(std::string_view text) {
  bool any = false;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    any = any || digit;
    if (!digit && c != '+' && c != '-' && c != '.' && c != 'e' && c != 'E') return false;
  }
  return any;
}

}  // namespace

std::optional<long double> read_decimal(std::string_view text) {
  text = without_blanks(text);
  if (text.starts_with('+') && !text.substr(1).starts_with('-')) text.remove_prefix(1);
  if (!is_spelt_as_decimal(text)) return std::nullopt;
  long double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (std::fabs(value) > std::numeric_limits<double>::max()) return std::nullopt;
  return value;
}

}  // namespace dyngen
