// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dyngen::runtime {

/// What a word of a text file looks like, whatever its decimal sign is.
enum class WordKind {
  kMissing,  ///< nothing, or "nan" and the like
  kNumber,   ///< digits with signs, points, commas, an exponent; hexadecimal; true or false
  kTime,     ///< a date or a time of day
  kText,
};

WordKind kind_of_word(std::string_view word);

/// The value of a word; NaN if it is missing; nothing if it is text, or no number with this decimal
/// sign. "0x1F", "16#1F", "2#101" are whole numbers, "true" is 1, "false" 0.
/// @param scratch  memory for the work
std::optional<double> value_of_word(std::string_view word, char decimal, std::string& scratch);

/// The decimal sign that words have: '.' or ','. A word such as "1,234" tells nothing while others
/// do; where none does, a comma is a decimal one.
struct DecimalEvidence {
  std::string point, comma, either;  ///< a word that shows it; empty: none does
  void add(std::string_view word);
};

/// A number of a text as a whole number of steps: exact where a double is not.
struct WholeNumber {
  long long count = 0;
  bool whole = true;  ///< false: a decimal number, and the step is 1e-9
};

/// True for whole numbers beyond 2^53 and decimals of 16 or more digits from 1e8 on: time stamps,
/// of which a double would lose the end.
bool needs_more_than_double(std::string_view word);

/// Reads "1423155837204875566", and "1423155837.204875566" in steps of 1e-9 (further digits are
/// cut). Nothing for other words, and for what 64 bits do not hold.
std::optional<WholeNumber> whole_number(std::string_view word, char decimal);

/// True for a unit that programs write: those of recordings, and amperes, volts, counts, ...
bool is_log_unit(std::string_view word);

/// "A1 [deg]" -> "A1", "deg"; a name whose brackets hold no unit ("q[1]", "torque (est)") stays
/// whole.
struct NameAndUnit {
  std::string name, unit;
};
NameAndUnit split_unit(std::string_view text);

/// Names that come again get " (2)", " (3)", ... @return  those that were changed, as they were
std::vector<std::string> make_unique(std::vector<std::string>& names);

}  // namespace dyngen::runtime
