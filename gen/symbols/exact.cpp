// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/symbols/exact.h"

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

GiNaC::ex rational_or_float(const GiNaC::ex& value) {
  if (GiNaC::is_a<GiNaC::numeric>(value)) return value;
  const PrecisionScope precision;
  return approximate(value);
}

GiNaC::ex exact_sin(const GiNaC::ex& angle) { return rational_or_float(GiNaC::sin(angle)); }
GiNaC::ex exact_cos(const GiNaC::ex& angle) { return rational_or_float(GiNaC::cos(angle)); }

namespace {

bool is_rounding(const GiNaC::ex& term) {
  GiNaC::ex number = term;
  if (GiNaC::is_a<GiNaC::mul>(term)) number = term.op(term.nops() - 1);  // where GiNaC keeps it
  return GiNaC::is_a<GiNaC::numeric>(number) &&
         GiNaC::abs(GiNaC::ex_to<GiNaC::numeric>(number)) < GiNaC::numeric("1e-45");
}

}  // namespace

GiNaC::ex drop_rounding(const GiNaC::ex& expression) {
  const GiNaC::ex expanded = expression.expand();
  if (!GiNaC::is_a<GiNaC::add>(expanded)) return is_rounding(expanded) ? GiNaC::ex(0) : expanded;
  GiNaC::ex sum = 0;
  for (std::size_t i = 0; i < expanded.nops(); ++i) {
    if (!is_rounding(expanded.op(i))) sum += expanded.op(i);
  }
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
