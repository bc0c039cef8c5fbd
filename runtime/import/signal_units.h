// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/recordings/units.h"

namespace dyngen::runtime {

/// What the value of a signal is before it is a torque or an angle.
enum class RawKind {
  kSi,       ///< the quantity itself
  kCounts,   ///< of an encoder: needs counts per turn
  kCurrent,  ///< of a motor: needs its torque constant
  kPercent   ///< of the rated torque
};

/// A unit of a raw signal: what kind of value it is, and the conversion to rad, A, a fraction, or
/// the quantity's SI unit.
struct SignalUnit {
  RawKind kind = RawKind::kSi;
  UnitConversion conversion;
};

/// Knows besides unit_conversion(): counts, counts/s, of torques A, mA and %.
/// @return nothing if the word is no unit of this quantity
std::optional<SignalUnit> signal_unit(std::string_view word, ColumnQuantity quantity);

/// For messages.
std::string known_signal_units(ColumnQuantity quantity);

/// A name without a unit in brackets at its end: "A1" of "A1 [deg]"; what is in the brackets.
struct ColumnLabel {
  std::string_view name, unit;
};
ColumnLabel name_and_unit(std::string_view column);

}  // namespace dyngen::runtime
