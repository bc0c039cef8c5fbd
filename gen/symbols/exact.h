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

/// The double next to an exact number.
double to_double(const GiNaC::ex& value);

/// The shortest decimal that reads back as the number's double, always with a point or an exponent ("9.81", "2.0").
std::string shortest_decimal(const GiNaC::ex& value);

/// The same for float.
std::string shortest_decimal_float(const GiNaC::ex& value);

}  // namespace dyngen
