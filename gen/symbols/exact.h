// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <string>

namespace dyngen {

/// Sixty digits for GiNaC's approximations, which it keeps in a global, for one scope.
class PrecisionScope {
 public:
  PrecisionScope() : saved_(GiNaC::Digits) { GiNaC::Digits = 60; }
  ~PrecisionScope() { GiNaC::Digits = saved_; }
  PrecisionScope(const PrecisionScope&) = delete;
  PrecisionScope& operator=(const PrecisionScope&) = delete;

 private:
  long saved_;
};

/// True for a number (no symbols in it): rationals, pi, roots, sin and cos of numbers.
bool is_number(const GiNaC::ex& value);

/// True if a number is zero: as it stands, or to 60 digits where no rule of algebra shows it
/// (sqrt(2)/2 - sin(pi/4) written by two roads).
bool is_zero_number(const GiNaC::ex& value);

/// The sign of a number: -1, 0, 1.
int number_sign(const GiNaC::ex& value);

/// sin and cos of a number: rational where they are, else to 60 digits, so that sums of products of
/// them stay short. What should cancel then leaves some 1e-60, which drop_rounding() takes away.
GiNaC::ex exact_sin(const GiNaC::ex& angle);
GiNaC::ex exact_cos(const GiNaC::ex& angle);

/// A number as it is if rational, else to 60 digits.
GiNaC::ex rational_or_float(const GiNaC::ex& value);

/// The short fraction that a 60-digit number is but for rounding (0 and 1 among them); others as
/// they are.
///
/// Sums of such numbers differ in the last digits with GiNaC's order of terms: what is decided by a
/// comparison must not.
GiNaC::ex settle_number(const GiNaC::ex& value);

/// Expands, and settles the number of each term: what is rounding alone is gone.
GiNaC::ex drop_rounding(const GiNaC::ex& expression);

/// The double next to an exact number.
double to_double(const GiNaC::ex& value);

/// The shortest decimal that reads back as the number's double, always with a point or an exponent
/// ("9.81", "2.0").
std::string shortest_decimal(const GiNaC::ex& value);

/// The same for float.
std::string shortest_decimal_float(const GiNaC::ex& value);

}  // namespace dyngen
