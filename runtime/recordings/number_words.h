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

}  // namespace dyngen::runtime
