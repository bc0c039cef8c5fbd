// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace dyngen::runtime {

enum class NumberStyle {
  kPlain,      ///< a decimal point, or none; no sign that parts thousands
  kAmbiguous,  ///< "1,234": the comma may be a decimal one or part thousands
  kNone,       ///< points and commas that no number has
};

/// Writes a number with a decimal point and without signs that part thousands: "0,123" becomes
/// "0.123", "1.234,5" and "1,234.5" become "1234.5", "1,234,567" becomes "1234567".
///
/// @param word  a number in which commas do not separate columns; changed
/// @param line  where it stands: "1,234" is 1.234 where no other number has a decimal point
NumberStyle use_decimal_point(std::string& word, std::string_view line);

/// True for what programs write for a value that they do not have: "", "na", "#n/a", "nan(ind)",
/// "1.#qnan", ... @param word  in small letters, without a sign
bool means_missing(std::string_view word);

/// The same as use_decimal_point() where the decimal sign is known. Thousands may be parted by the
/// other sign, by blanks (no-break ones too) or apostrophes; an exponent may begin with 'd', as
/// Fortran writes it.
///
/// @param word     in small letters; changed to what std::from_chars reads, without '+'
/// @param decimal  '.' or ','
/// @return false if it is no number then; the word may be changed
bool use_decimal_sign(std::string& word, char decimal);

}  // namespace dyngen::runtime
