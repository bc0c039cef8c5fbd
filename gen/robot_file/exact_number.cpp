// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_file/exact_number.h"

#include <cln/cln.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <limits>

namespace dyngen {

namespace {

cln::float_format_t low_format() { return cln::float_format(40); }
cln::float_format_t high_format() { return cln::float_format(80); }

/// How large an expression is: the nodes of its tree, the bits of its longest integer.
struct Extent {
  int nodes = 0;
  int bits = 0;
};

Extent measure(const GiNaC::ex& expression) {
  Extent extent{1, 0};
  if (GiNaC::is_exactly_a<GiNaC::numeric>(expression)) {
    const auto& number = GiNaC::ex_to<GiNaC::numeric>(expression);
    extent.bits = std::max(number.numer().int_length(), number.denom().int_length());
  }
  for (std::size_t i = 0; i < expression.nops(); ++i) {
    const Extent operand = measure(expression.op(i));
    extent.nodes += operand.nodes;
    extent.bits = std::max(extent.bits, operand.bits);
  }
  return extent;
}

/// The binary exponent: |x| is about 2^magnitude(x). x is not zero.
double magnitude(const cln::cl_R& x) {
  return static_cast<double>(cln::float_exponent(cln::cl_float(x, low_format())));
}

/// Throws if the magnitude of a result, known beforehand, would be out of bounds.
void check_magnitude(double bits) {
  if (bits > ExactNumber::kMaxBits) throw ArithmeticError("the result is too large");
  if (bits < -ExactNumber::kMaxBits) throw ArithmeticError("the result is too close to zero");
}

cln::cl_R rational_of(const GiNaC::ex& number) {
  return cln::realpart(GiNaC::ex_to<GiNaC::numeric>(number).to_cl_N());
}

/// 3 of "-3e2": the value of up to kMaxDigits digits.
cln::cl_I read_digits(std::string digits) {
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));
  return cln::cl_I(digits.c_str());
}

int read_decimal_exponent(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  int exponent = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), exponent);
  const bool in_range = status == std::errc() && end == text.data() + text.size() &&
                        exponent >= -ExactNumber::kMaxDecimalExponent &&
                        exponent <= ExactNumber::kMaxDecimalExponent;
  if (!in_range) {
    throw ArithmeticError("the number is outside the range of double",
                          "numbers lie between 2.3e-308 and 1.7e308");
  }
  return exponent;
}

cln::cl_R float_power(const cln::cl_R& base, const cln::cl_R& exponent,
                      cln::float_format_t format) {
  if (cln:: instanceof (exponent, cln::cl_I_ring)) {
    return cln::expt(base, cln::the<cln::cl_I>(exponent));
  }
  return cln::exp(exponent * cln::ln(cln::cl_float(base, format)));
}

}  // namespace

ExactNumber::ExactNumber(GiNaC::ex exact, const Approximation& approximation)
    : exact_(std::move(exact)), approximation_(approximation) {
  const bool is_number = GiNaC::is_exactly_a<GiNaC::numeric>(exact_);
  if (is_number && !GiNaC::ex_to<GiNaC::numeric>(exact_).is_rational()) {
    throw ArithmeticError("the result is not a real number");
  }
  const Extent extent = measure(exact_);
  if (extent.bits > kMaxBits) {
    throw ArithmeticError("the result has too many digits",
                          fmt::format("numbers are exact, up to {} digits", kMaxBits * 3 / 10));
  }
  if (extent.nodes > kMaxNodes) {
    throw ArithmeticError("the expression is too long to be kept exact");
  }
  if (is_number) {
    approximation_ = {rational_of(exact_), rational_of(exact_)};
    return;
  }
  const auto& [low, high] = approximation_;
  const bool certain = !cln::zerop(low) && cln::abs(low - high) * 2 <= cln::abs(high);
  if (certain) {
    check_magnitude(magnitude(high));
  } else {
    *this = ExactNumber();
  }
}

ExactNumber ExactNumber::from_decimal(std::string_view text) {
  const std::size_t e = std::min(text.find_first_of("eE"), text.size());
  const std::size_t point = std::min(text.find('.'), e);
  std::string digits(text.substr(0, point));
  const std::string_view fraction = point < e ? text.substr(point + 1, e - point - 1) : "";
  digits += fraction;
  if (digits.size() > static_cast<std::size_t>(kMaxDigits)) {
    throw ArithmeticError(fmt::format("the number has {} digits", digits.size()),
                          fmt::format("at most {} are read", kMaxDigits));
  }
  int exponent = e < text.size() ? read_decimal_exponent(text.substr(e + 1)) : 0;
  exponent -= static_cast<int>(fraction.size());
  const cln::cl_RA scale = cln::expt(cln::cl_RA(10), cln::cl_I(exponent));
  return {GiNaC::numeric(cln::cl_N(read_digits(std::move(digits)) * scale)), {}};
}

ExactNumber ExactNumber::from_exact(const GiNaC::ex& exact) {
  const auto approximate = [&](long digits) -> cln::cl_R {
    const long saved = GiNaC::Digits;
    GiNaC::Digits = digits;
    const GiNaC::ex value = exact.evalf();
    GiNaC::Digits = saved;
    return rational_of(value);
  };
  constexpr long kLowDigits = 40, kHighDigits = 80;
  return {exact, {approximate(kLowDigits), approximate(kHighDigits)}};
}

ExactNumber ExactNumber::pi() {
  return {GiNaC::Pi, {cln::pi(low_format()), cln::pi(high_format())}};
}

ExactNumber ExactNumber::degree() { return pi() / from_decimal("180"); }

bool ExactNumber::is_rational() const { return GiNaC::is_exactly_a<GiNaC::numeric>(exact_); }

bool ExactNumber::is_integer() const {
  return is_rational() && GiNaC::ex_to<GiNaC::numeric>(exact_).is_integer();
}

bool ExactNumber::is_zero() const { return cln::zerop(approximation_.high); }

bool ExactNumber::is_negative() const { return cln::minusp(approximation_.high); }

bool ExactNumber::fits_double() const {
  using Limits = std::numeric_limits<double>;
  const cln::cl_R size = cln::abs(approximation_.high);
  return is_zero() || (size <= cln::rational(cln::cl_F(Limits::max())) &&
                       size >= cln::rational(cln::cl_F(Limits::min())));
}

ExactNumber operator-(const ExactNumber& a) {
  return {-a.exact_, {-a.approximation_.low, -a.approximation_.high}};
}

ExactNumber operator+(const ExactNumber& a, const ExactNumber& b) {
  return {
      a.exact_ + b.exact_,
      {a.approximation_.low + b.approximation_.low, a.approximation_.high + b.approximation_.high}};
}

ExactNumber operator-(const ExactNumber& a, const ExactNumber& b) { return a + -b; }

ExactNumber operator*(const ExactNumber& a, const ExactNumber& b) {
  return {
      a.exact_ * b.exact_,
      {a.approximation_.low * b.approximation_.low, a.approximation_.high * b.approximation_.high}};
}

ExactNumber operator/(const ExactNumber& a, const ExactNumber& b) {
  if (b.is_zero()) throw ArithmeticError("division by zero");
  return {
      a.exact_ / b.exact_,
      {a.approximation_.low / b.approximation_.low, a.approximation_.high / b.approximation_.high}};
}

ExactNumber power(const ExactNumber& base, const ExactNumber& exponent) {
  const cln::cl_R& e = exponent.approximation_.high;
  if (base.is_zero()) {
    if (exponent.is_zero()) throw ArithmeticError("0^0 is not defined");
    if (exponent.is_negative()) throw ArithmeticError("division by zero");
    return {};
  }
  if (base.is_negative() && !exponent.is_integer()) {
    throw ArithmeticError("a negative number has no real power with a broken exponent");
  }
  if (cln::abs(e) > ExactNumber::kMaxExponent) {
    throw ArithmeticError("the exponent is too large",
                          fmt::format("exponents go up to {}", ExactNumber::kMaxExponent));
  }
  if (exponent.is_rational() &&
      GiNaC::ex_to<GiNaC::numeric>(exponent.exact_).denom() > ExactNumber::kMaxExponent) {
    throw ArithmeticError("the exponent's fraction is too fine",
                          fmt::format("its denominator goes up to {}", ExactNumber::kMaxExponent));
  }
  // Bounds the result before GiNaC works it out: 9^9^9 would fill the memory.
  const double times = std::max(1.0, cln::double_approx(cln::abs(e)));
  if (measure(base.exact_).bits * times > 2.0 * ExactNumber::kMaxBits) {
    throw ArithmeticError(
        "the result has too many digits",
        fmt::format("numbers are exact, up to {} digits", ExactNumber::kMaxBits * 3 / 10));
  }
  check_magnitude(magnitude(base.approximation_.high) * cln::double_approx(e));
  return {GiNaC::pow(base.exact_, exponent.exact_),
          {float_power(base.approximation_.low, exponent.approximation_.low, low_format()),
           float_power(base.approximation_.high, exponent.approximation_.high, high_format())}};
}

ExactNumber square_root(const ExactNumber& x) {
  if (x.is_negative()) throw ArithmeticError("square root of a negative number");
  if (x.is_zero()) return {};
  return {GiNaC::sqrt(x.exact_),
          {cln::sqrt(cln::cl_float(x.approximation_.low, low_format())),
           cln::sqrt(cln::cl_float(x.approximation_.high, high_format()))}};
}

namespace {

void check_angle(const cln::cl_R& angle) {
  if (cln::abs(angle) <= ExactNumber::kMaxAngle) return;
  throw ArithmeticError("the angle is too large",
                        fmt::format("sin and cos take radians up to {}", ExactNumber::kMaxAngle));
}

}  // namespace

ExactNumber sine(const ExactNumber& x) {
  check_angle(x.approximation_.high);
  return {GiNaC::sin(x.exact_),
          {cln::sin(cln::cl_float(x.approximation_.low, low_format())),
           cln::sin(cln::cl_float(x.approximation_.high, high_format()))}};
}

ExactNumber cosine(const ExactNumber& x) {
  check_angle(x.approximation_.high);
  return {GiNaC::cos(x.exact_),
          {cln::cos(cln::cl_float(x.approximation_.low, low_format())),
           cln::cos(cln::cl_float(x.approximation_.high, high_format()))}};
}

}  // namespace dyngen
