// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dyngen::runtime {

/// What a column of a recording measures.
enum class ColumnQuantity { kTime, kPosition, kVelocity, kAcceleration, kTorque, kTemperature };

/// A value in SI units is value * factor / divisor + offset. The divisor keeps decimals: 14 ms are
/// the same number as 0.014 s.
struct UnitConversion {
  double factor = 1, divisor = 1, offset = 0;

  [[nodiscard]] double operator()(double value) const { return value * factor / divisor + offset; }
  [[nodiscard]] bool changes() const { return factor != 1 || divisor != 1 || offset != 0; }
  bool operator==(const UnitConversion&) const = default;
};

/// The conversion of a unit as programs write it ("deg", "[ms]", "(N m)", "°/s"), to s, rad or m,
/// rad/s or m/s, rad/s^2 or m/s^2, N m or N, degrees Celsius; nothing if the word is no unit of
/// this quantity.
std::optional<UnitConversion> unit_conversion(std::string_view word, ColumnQuantity quantity);

/// Of what a joint's unit is: an angle (deg, rad/s, N m) or a length (mm, m/s, N).
enum class MotionKind { kAngle, kLength };

/// Nothing of times and temperatures, and of words that are no unit of the quantity.
std::optional<MotionKind> motion_kind(std::string_view word, ColumnQuantity quantity);

/// Units of a quantity that are known, for messages: "s, ms, us, ns or min".
std::string_view known_units(ColumnQuantity quantity);

/// A unit in small ASCII letters, without signs of multiplication: "deg/s" of "[°/s]".
std::string plain_unit(std::string_view word);

/// Without blanks and one pair of [], (), <> or {} around it.
std::string_view without_brackets(std::string_view word);

}  // namespace dyngen::runtime
