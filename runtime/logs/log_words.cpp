// SPDX-License-Identifier: MIT
#include "runtime/logs/log_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "runtime/logs/time_words.h"
#include "runtime/recordings/columns.h"
#include "runtime/recordings/number_words.h"
#include "runtime/recordings/units.h"

namespace dyngen::runtime {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr int kStepDigits = 9;             ///< of WholeNumber: 1e-9
constexpr std::size_t kDoubleDigits = 15;  ///< decimal digits that a double always keeps
constexpr std::size_t kStampDigits = 9;    ///< before the point: seconds since 1973 or later

bool is_decimal_digit(char c) { return c >= '0' && c <= '9'; }

std::string in_small_letters(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::string_view without_sign(std::string_view word) {
  return word.substr(word.starts_with('-') || word.starts_with('+') ? 1 : 0);
}

/// "0x1f", "16#1f", "2#101": its value.
std::optional<double> value_with_base(std::string_view lower) {
  constexpr std::array<std::pair<std::string_view, int>, 5> kPrefixes = {
      {{"0x", 16}, {"16#", 16}, {"8#", 8}, {"2#", 2}, {"0b", 2}}};
  for (const auto& [prefix, base] : kPrefixes) {
    if (!lower.starts_with(prefix)) continue;
    std::string digits(lower.substr(prefix.size()));
    digits.erase(std::remove(digits.begin(), digits.end(), '_'), digits.end());
    unsigned long long value = 0;
    const auto [stop, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
    if (error != std::errc() || stop != digits.data() + digits.size()) return std::nullopt;
    return static_cast<double>(value);
  }
  return std::nullopt;
}

/// Digits with signs between them that could be decimal ones or part thousands.
bool has_form_of_number(std::string_view lower) {
  std::string as_point(lower), as_comma(lower);
  return use_decimal_sign(as_point, '.') || use_decimal_sign(as_comma, ',');
}

constexpr std::array<std::string_view, 36> kOtherUnits = {
    "a",      "ma", "v",     "mv",   "w",      "kw",      "hz",    "khz",  "%",
    "1",      "-",  "count", "inc",  "counts", "incs",    "ticks", "nm/a", "n/m",
    "nm/rad", "kg", "g",     "j",    "pa",     "bar",     "mbar",  "ohm",  "nms/rad",
    "pwm",    "f",  "degf",  "kgm2", "arms",   "samples", "nm/nm", "nms",  "as"};

}  // namespace

WordKind kind_of_word(std::string_view word) {
  double plain = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), plain);
  if (error == std::errc() && stop == word.data() + word.size() && std::isfinite(plain)) {
    return WordKind::kNumber;
  }
  constexpr std::size_t kLongestNumber = 64;
  const std::string lower = in_small_letters(word.substr(0, kLongestNumber + 1));
  if (means_missing(lower) || means_missing(without_sign(lower))) return WordKind::kMissing;
  if (lower.size() > kLongestNumber) return WordKind::kText;
  if (lower == "true" || lower == "false" || value_with_base(lower)) return WordKind::kNumber;
  if (has_form_of_number(lower)) return WordKind::kNumber;
  return read_time_word(word) ? WordKind::kTime : WordKind::kText;
}

std::optional<double> value_of_word(std::string_view word, char decimal, std::string& scratch) {
  scratch = in_small_letters(word);
  if (means_missing(scratch) || means_missing(without_sign(scratch))) return kNoValue;
  if (scratch == "true") return 1;
  if (scratch == "false") return 0;
  if (const auto value = value_with_base(scratch)) return value;
  if (!use_decimal_sign(scratch, decimal)) return std::nullopt;
  double value = 0;
  const auto [stop, error] =
      std::from_chars(scratch.data(), scratch.data() + scratch.size(), value);
  if (error == std::errc::result_out_of_range) {
    return scratch.find("e-") == scratch.npos ? kNoValue : 0;
  }
  if (error != std::errc() || stop != scratch.data() + scratch.size()) return std::nullopt;
  return value;
}

void DecimalEvidence::add(std::string_view word) {
  if (word.find_first_of(".,") == word.npos) return;
  std::string as_point = in_small_letters(word), as_comma = as_point;
  const bool point_fits = use_decimal_sign(as_point, '.');
  const bool comma_fits = use_decimal_sign(as_comma, ',');
  std::string* shown = point_fits && comma_fits ? &either
                       : point_fits             ? &point
                       : comma_fits             ? &comma
                                                : nullptr;
  // "1.234" is a number with a point wherever nothing says otherwise
  if (shown != nullptr && shown->empty()) shown->assign(word);
}

bool needs_more_than_double(std::string_view word) {
  word = without_sign(trimmed(word));
  const std::size_t whole = std::min(word.find_first_not_of("0123456789"), word.size());
  if (whole == word.size()) {
    unsigned long long value = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && value > 1ULL << 53;
  }
  if (whole < kStampDigits || (word[whole] != '.' && word[whole] != ',')) return false;
  const std::string_view decimals = word.substr(whole + 1);
  return std::all_of(decimals.begin(), decimals.end(), is_decimal_digit) &&
         whole + decimals.size() > kDoubleDigits;
}

std::optional<WholeNumber> whole_number(std::string_view word, char decimal) {
  word = trimmed(word);
  const std::size_t point = std::min(word.find(decimal), word.size());
  std::string digits(word.substr(0, point));
  if (digits.starts_with('+')) digits.erase(0, 1);
  WholeNumber number;
  if (point < word.size()) {
    std::string decimals(word.substr(point + 1));
    if (!std::all_of(decimals.begin(), decimals.end(), is_decimal_digit)) return std::nullopt;
    decimals.resize(kStepDigits, '0');
    digits += decimals;
    number.whole = false;
  }
  const auto [stop, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), number.count);
  if (error != std::errc() || stop != digits.data() + digits.size()) return std::nullopt;
  return number;
}

bool is_log_unit(std::string_view word) {
  word = without_brackets(word);
  if (word.empty()) return false;
  // single letters are names more often than not
  constexpr std::string_view kLetters = "AVWJFCKNsmg1%-";
  if (word.size() == 1) return kLetters.find(word.front()) != kLetters.npos;
  for (const ColumnQuantity quantity :
       {ColumnQuantity::kTime, ColumnQuantity::kPosition, ColumnQuantity::kVelocity,
        ColumnQuantity::kAcceleration, ColumnQuantity::kTorque, ColumnQuantity::kTemperature}) {
    if (unit_conversion(word, quantity)) return true;
  }
  const std::string plain = word == "-" ? "-" : plain_unit(word);
  return std::find(kOtherUnits.begin(), kOtherUnits.end(), plain) != kOtherUnits.end();
}

NameAndUnit split_unit(std::string_view text) {
  text = trimmed(text);
  constexpr std::array<std::string_view, 2> kPairs = {"[]", "()"};
  for (const std::string_view pair : kPairs) {
    if (text.empty() || text.back() != pair[1]) continue;
    const std::size_t open = text.rfind(pair[0]);
    if (open == text.npos || open == 0) continue;
    const std::string_view unit = trimmed(text.substr(open + 1, text.size() - open - 2));
    std::string_view name = trimmed(text.substr(0, open));
    const bool index = !unit.empty() && std::all_of(unit.begin(), unit.end(), is_decimal_digit);
    const bool apart = is_blank(text[open - 1]) && pair == "[]";  // what is unknown is a unit too
    if (name.empty() || index || unit.empty() || (!apart && !is_log_unit(unit))) continue;
    while (name.size() > 1 && name.back() == '_') name.remove_suffix(1);
    return {std::string(name), std::string(unit)};
  }
  return {std::string(text), ""};
}

std::vector<std::string> make_unique(std::vector<std::string>& names) {
  std::vector<std::string> changed;
  std::set<std::string> used(names.begin(), names.end()), seen;
  std::map<std::string, std::size_t> counts;
  for (std::string& name : names) {
    if (seen.insert(name).second) continue;
    changed.push_back(name);
    std::size_t& count = counts.try_emplace(name, 1).first->second;
    std::string other;
    do {
      other = fmt::format("{} ({})", name, ++count);
    } while (!used.insert(other).second);
    name = other;
    seen.insert(name);
  }
  return changed;
}

}  // namespace dyngen::runtime
