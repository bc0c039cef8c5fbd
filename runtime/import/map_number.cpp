// SPDX-License-Identifier: MIT
#include "runtime/import/map_number.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "runtime/recordings/columns.h"
#include "runtime/recordings/units.h"

namespace dyngen::runtime {
namespace {

/// Reads a product from the front of a text.
class ProductReader {
 public:
  explicit ProductReader(std::string_view text) : rest_(trimmed(text)) {}

  [[nodiscard]] std::string_view rest() const { return rest_; }

  std::optional<double> product() {
    std::optional<double> value = factor();
    while (value) {
      rest_ = trimmed(rest_);
      if (rest_.empty() || (rest_.front() != '*' && rest_.front() != '/')) break;
      const bool divides = rest_.front() == '/';
      rest_.remove_prefix(1);
      const std::optional<double> next = factor();
      if (!next || (divides && *next == 0)) return std::nullopt;
      *value = divides ? *value / *next : *value * *next;
    }
    return value;
  }

 private:
  std::optional<double> factor() {
    rest_ = trimmed(rest_);
    double sign = 1;
    if (!rest_.empty() && (rest_.front() == '-' || rest_.front() == '+')) {
      sign = rest_.front() == '-' ? -1 : 1;
      rest_.remove_prefix(1);
    }
    if (rest_.starts_with("pi") && (rest_.size() == 2 || !is_letter(rest_[2]))) {
      rest_.remove_prefix(2);
      return sign * std::numbers::pi;
    }
    if (rest_.empty() || ((rest_.front() < '0' || rest_.front() > '9') && rest_.front() != '.')) {
      return std::nullopt;
    }
    double value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return sign * value;
  }
  static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

  std::string_view rest_;
};

struct WordFactor {
  std::string_view word;  ///< as plain_unit() has it
  double factor;
};

template <std::size_t kCount>
std::optional<double> factor_of_word(const std::array<WordFactor, kCount>& words,
                                     std::string_view unit) {
  const std::string plain = plain_unit(unit);
  for (const WordFactor& word : words) {
    if (word.word == plain) return word.factor;
  }
  return std::nullopt;
}

std::optional<double> converted(double value, std::string_view unit, ColumnQuantity quantity) {
  const auto conversion = unit_conversion(unit, quantity);
  return conversion ? std::optional((*conversion)(value)) : std::nullopt;
}

std::optional<double> times(double value, std::optional<double> factor) {
  return factor ? std::optional(value * *factor) : std::nullopt;
}

/// The value with its unit, which is not empty.
std::optional<double> with_unit(double value, std::string_view unit, MapNumber kind) {
  constexpr std::array<WordFactor, 2> kRates = {{{"hz", 1}, {"khz", 1e3}}};
  constexpr std::array<WordFactor, 3> kConstants = {{{"nm/a", 1}, {"mnm/a", 1e-3}, {"n/a", 1}}};
  constexpr std::array<WordFactor, 2> kVolts = {{{"v", 1}, {"mv", 1e-3}}};
  constexpr std::array<WordFactor, 4> kOhms = {
      {{"ohm", 1}, {"mohm", 1e-3}, {"\xCE\xA9", 1}, {"\xE2\x84\xA6", 1}}};
  constexpr std::array<WordFactor, 2> kBackEmfs = {{{"vs/rad", 1}, {"v/(rad/s)", 1}}};
  switch (kind) {
    case MapNumber::kRatio:
      return std::nullopt;
    case MapNumber::kDuration:
      return converted(value, unit, ColumnQuantity::kTime);
    case MapNumber::kRate:
      return times(value, factor_of_word(kRates, unit));
    case MapNumber::kPosition:
      return converted(value, unit, ColumnQuantity::kPosition);
    case MapNumber::kTorque:
      return converted(value, unit, ColumnQuantity::kTorque);
    case MapNumber::kConstant:
      return times(value, factor_of_word(kConstants, unit));
    case MapNumber::kVoltage:
      return times(value, factor_of_word(kVolts, unit));
    case MapNumber::kResistance:
      return times(value, factor_of_word(kOhms, unit));
    case MapNumber::kBackEmf:
      return times(value, factor_of_word(kBackEmfs, unit));
  }
  return std::nullopt;
}

std::string expectation(MapNumber kind) {
  switch (kind) {
    case MapNumber::kRatio:
      return "a number without a unit, such as 45, -48 or 1798/7";
    case MapNumber::kDuration:
      return "a time with its unit, such as '3 ms' or '0.5 s'";
    case MapNumber::kRate:
      return "a rate, such as '1000 Hz'";
    case MapNumber::kPosition:
      return "an angle or a length with its unit, such as '-90 deg', 'pi/2 rad' or '12 mm'";
    case MapNumber::kTorque:
      return "a torque or a force, such as '12.5 N m'";
    case MapNumber::kConstant:
      return "a torque constant, such as '0.1 N m/A'";
    case MapNumber::kVoltage:
      return "a voltage, such as '24 V'";
    case MapNumber::kResistance:
      return "a resistance, such as '3.4 ohm'";
    case MapNumber::kBackEmf:
      return "a voltage constant, such as '0.463 V s/rad'";
  }
  return {};
}

}  // namespace

ReadNumber read_map_number(std::string_view text, MapNumber kind) {
  ProductReader reader(text);
  const std::optional<double> value = reader.product();
  if (!value) return {std::nullopt, expectation(kind), {}};
  const std::string_view unit = trimmed(reader.rest());
  const bool wants_unit = kind == MapNumber::kDuration || kind == MapNumber::kPosition;
  if (unit.empty() && wants_unit && *value != 0) return {std::nullopt, expectation(kind), {}};
  const std::optional<double> result = unit.empty() ? value : with_unit(*value, unit, kind);
  if (!result) return {std::nullopt, expectation(kind), {}};
  // a product of large factors
  if (!std::isfinite(*result)) return {std::nullopt, "a finite number", {}};
  return {result, {}, std::string(unit)};
}

}  // namespace dyngen::runtime
