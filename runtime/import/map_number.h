// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dyngen::runtime {

/// What a number of a map is.
enum class MapNumber {
  kRatio,       ///< without a unit
  kDuration,    ///< s; a unit is needed unless it is 0
  kRate,        ///< Hz
  kPosition,    ///< rad or m; a unit is needed unless it is 0
  kTorque,      ///< N m or N
  kConstant,    ///< N m/A or N/A
  kVoltage,     ///< V
  kResistance,  ///< ohm
  kBackEmf      ///< V s/rad
};

/// A number of a map in SI units, or why it is none.
struct ReadNumber {
  std::optional<double> value;
  std::string expected;  ///< where there is no value
  std::string unit;      ///< as written; may be empty
};

/// Reads "0.463", "1798/7", "-pi/2 rad", "3 ms": numbers and pi with * and / between them, then a
/// unit.
ReadNumber read_map_number(std::string_view text, MapNumber kind);

}  // namespace dyngen::runtime
