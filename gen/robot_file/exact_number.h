// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cln/real.h>
#include <ginac/ginac.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace dyngen {

/// An operation has no real result, or one beyond the bounds that keep every file cheap to read.
class ArithmeticError : public std::runtime_error {
 public:
  explicit ArithmeticError(const std::string& message, std::string hint = {})
      : std::runtime_error(message), hint_(std::move(hint)) {}

  [[nodiscard]] const std::string& hint() const { return hint_; }

 private:
  std::string hint_;
};

/// A real constant, kept exact: a rational, or an expression in pi, roots, sines and cosines.
///
/// Whether such an expression is zero, GiNaC cannot always tell. So two approximations go along
/// with it, to 40 and to 80 digits. Where they agree, the number is not zero and its sign is known;
/// where they do not, everything has cancelled (sin(1)^2+cos(1)^2-1) and the number is made exactly
/// 0. Invariant: a number that is not rational is neither zero nor larger than kMaxNodes nor made
/// of integers longer than kMaxBits.
class ExactNumber {
 public:
  static constexpr int kMaxDigits = 400;  ///< of a decimal number as written
  static constexpr int kMaxDecimalExponent = 400;
  static constexpr int kMaxExponent = 1000;  ///< of a power
  static constexpr int kMaxBits = 4096;      ///< of a numerator or denominator
  static constexpr int kMaxNodes = 500;      ///< of an irrational expression's tree
  static constexpr int kMaxAngle = 1000000;  ///< of sin and cos; beyond, digits are lost

  ExactNumber() = default;  ///< 0
  /// From digits with at most one point and perhaps an exponent: 0.1 is exactly 1/10.
  static ExactNumber from_decimal(std::string_view text);
  /// From the exact value of another one. @throws ArithmeticError  beyond the bounds
  static ExactNumber from_exact(const GiNaC::ex& exact);
  static ExactNumber pi();
  static ExactNumber degree();  ///< pi/180

  [[nodiscard]] const GiNaC::ex& exact() const { return exact_; }
  [[nodiscard]] bool is_rational() const;
  [[nodiscard]] bool is_integer() const;
  [[nodiscard]] bool is_zero() const;
  [[nodiscard]] bool is_negative() const;

  /// Whether a double can hold the number: finite, and not rounded to zero or to a number with few
  /// digits.
  [[nodiscard]] bool fits_double() const;

  friend ExactNumber operator-(const ExactNumber& a);
  friend ExactNumber operator+(const ExactNumber& a, const ExactNumber& b);
  friend ExactNumber operator-(const ExactNumber& a, const ExactNumber& b);
  friend ExactNumber operator*(const ExactNumber& a, const ExactNumber& b);
  friend ExactNumber operator/(const ExactNumber& a, const ExactNumber& b);
  friend ExactNumber power(const ExactNumber& base, const ExactNumber& exponent);
  friend ExactNumber square_root(const ExactNumber& x);
  friend ExactNumber sine(const ExactNumber& x);
  friend ExactNumber cosine(const ExactNumber& x);

 private:
  /// The number to 40 and to 80 digits; both are the number itself where it is rational.
  struct Approximation {
    cln::cl_R low = 0;
    cln::cl_R high = 0;
  };

  ExactNumber(GiNaC::ex exact, const Approximation& approximation);

  GiNaC::ex exact_ = 0;
  Approximation approximation_;
};

}  // namespace dyngen
