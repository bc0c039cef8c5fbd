// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/symbols/exact.h"

#include <cln/integer.h>
#include <cln/rational.h>
#include <cln/real.h>
#include <fmt/format.h>

#include "gen/diagnostic/assert.h"

namespace dyngen {
namespace {

GiNaC::numeric approximate(const GiNaC::ex& value) {
  const GiNaC::ex result = value.evalf();
  DYNGEN_ASSERT(GiNaC::is_a<GiNaC::numeric>(result), "not a number");
  const GiNaC::numeric& number = GiNaC::ex_to<GiNaC::numeric>(result);
  return number.is_real() ? number : number.real();
}

// 60 digits less what sums of some hundred terms lose; a number that is no short fraction comes
// within 1e-30 of one with this denominator, far from the tolerance.
const cln::cl_RA& tolerance_of_fractions() {
  static const cln::cl_RA kTolerance("1/1000000000000000000000000000000000000000000");
  return kTolerance;
}
const cln::cl_I& largest_denominator() {
  static const cln::cl_I kLargest("1000000000000000");
  return kLargest;
}

std::string with_point(std::string text) {
  if (text.find_first_of(".eE") == std::string::npos) text += ".0";
  return text;
}

}  // namespace

bool is_number(const GiNaC::ex& value) {
  if (GiNaC::is_a<GiNaC::numeric>(value)) return true;
  if (GiNaC::is_a<GiNaC::symbol>(value)) return false;
  for (auto it = value.preorder_begin(); it != value.preorder_end(); ++it) {
    if (GiNaC::is_a<GiNaC::symbol>(*it)) return false;
  }
  return true;
}

bool is_zero_number(const GiNaC::ex& value) {
  if (value.is_zero()) return true;
  if (value.info(GiNaC::info_flags::rational) || !is_number(value)) return false;
  const PrecisionScope precision;
  return GiNaC::abs(approximate(value)) < GiNaC::numeric("1e-50");
}

int number_sign(const GiNaC::ex& value) {
  if (is_zero_number(value)) return 0;
  const PrecisionScope precision;
  return approximate(value).is_positive() ? 1 : -1;
}

GiNaC::ex settle_number(const GiNaC::ex& value) {
  if (!GiNaC::is_a<GiNaC::numeric>(value) || value.info(GiNaC::info_flags::rational)) return value;
  const cln::cl_R number = cln::the<cln::cl_R>(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N());
  const cln::cl_R tolerance = (cln::abs(number) + 1) * tolerance_of_fractions();
  // convergents of the continued fraction
  cln::cl_R rest = number;
  cln::cl_I p0 = 0, q0 = 1, p1 = 1, q1 = 0;
  while (true) {
    const cln::cl_I whole = cln::floor1(rest);
    const cln::cl_I p2 = whole * p1 + p0;
    const cln::cl_I q2 = whole * q1 + q0;
    p0 = p1;
    q0 = q1;
    p1 = p2;
    q1 = q2;
    if (q1 > largest_denominator()) return value;
    if (cln::abs(number * q1 - p1) < tolerance * q1) return GiNaC::numeric(cln::cl_RA(p1) / q1);
    rest = 1 / (rest - cln::cl_R(whole));
  }
}

GiNaC::ex rational_or_float(const GiNaC::ex& value) {
  if (GiNaC::is_a<GiNaC::numeric>(value)) return settle_number(value);
  const PrecisionScope precision;
  return settle_number(approximate(value));
}

GiNaC::ex exact_sin(const GiNaC::ex& angle) { return rational_or_float(GiNaC::sin(angle)); }
GiNaC::ex exact_cos(const GiNaC::ex& angle) { return rational_or_float(GiNaC::cos(angle)); }

namespace {

/// A term with its number settled.
GiNaC::ex settle_term(const GiNaC::ex& term) {
  if (!GiNaC::is_a<GiNaC::mul>(term)) return settle_number(term);
  const GiNaC::ex number = term.op(term.nops() - 1);  // where GiNaC keeps it
  const GiNaC::ex settled = settle_number(number);
  return settled.is_equal(number) ? term : (term / number) * settled;
}

}  // namespace

GiNaC::ex drop_rounding(const GiNaC::ex& expression) {
  const GiNaC::ex expanded = expression.expand();
  if (!GiNaC::is_a<GiNaC::add>(expanded)) return settle_term(expanded);
  GiNaC::ex sum = 0;
  for (std::size_t i = 0; i < expanded.nops(); ++i) sum += settle_term(expanded.op(i));
  return sum;
}

double to_double(const GiNaC::ex& value) {
  if (is_zero_number(value)) return 0.0;
  const PrecisionScope precision;
  return approximate(value).to_double();
}

std::string shortest_decimal(const GiNaC::ex& value) {
  return with_point(fmt::format("{}", to_double(value)));
}

std::string shortest_decimal_float(const GiNaC::ex& value) {
  return with_point(fmt::format("{}", static_cast<float>(to_double(value))));
}

}  // namespace dyngen
