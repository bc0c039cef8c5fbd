// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/bodies/decimal.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <optional>

#include "gen/bodies/body_tree.h"
#include "gen/xml/decimal_number.h"

namespace dyngen {

std::string decimal(Real value) {
  if (value == 0) return "0";
  constexpr Real kRelative = 1e-14L, kAbsolute = 1e-15L;
  constexpr int kMostDigits = 21;
  std::string text;
  for (int digits = 1; digits <= kMostDigits; ++digits) {
    text = fmt::format("{:.{}g}", value, digits);
    const std::optional<Real> back = read_decimal(text);
    if (back && std::fabs(*back - value) <= kRelative * std::fabs(value) + kAbsolute) break;
  }
  // a number below the absolute tolerance is spelt "0" or by its first digit
  return read_decimal(text).value_or(0) == 0 ? "0" : text;
}

std::string exact_decimal(Real value) {
  const auto rounded = static_cast<double>(value);
  return rounded == 0 ? "0" : fmt::format("{}", rounded);
}

std::string angle_text(Real angle) {
  constexpr Real kStep = kRealPi / 12;
  const Real steps = std::round(angle / kStep);
  constexpr Real kMostSteps = 1e6L;
  if (!(std::fabs(steps) <= kMostSteps) || std::fabs(angle - steps * kStep) > kSameAngle) {
    return decimal(angle);
  }
  const long count = std::lround(steps);
  if (count == 0) return "0";
  const long common = std::gcd(count, 12L);
  const long numerator = std::labs(count) / common, denominator = 12 / common;
  return fmt::format("{}{}pi{}", count < 0 ? "-" : "",
                     numerator == 1 ? "" : fmt::format("{}*", numerator),
                     denominator == 1 ? "" : fmt::format("/{}", denominator));
}

}  // namespace dyngen
