// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dyngen::runtime {

/// What a column's name says that it is.
enum class ColumnRole {
  kTime,
  kPosition,
  kVelocity,
  kAcceleration,
  kTorque,
  kCurrent,
  kDuty,
  kVoltage,
  kTemperature,
  kFlag
};

/// Words of a name in small letters: "ActPos_1" has act, pos and 1.
std::vector<std::string> words_of(std::string_view name);

/// The role of a name, by its words; nothing: they say none.
std::optional<ColumnRole> role_of_words(const std::vector<std::string>& words);

/// The word by which a name is no measurement ("cmd", "target", "error"); empty: there is none.
std::string commanded_word(const std::vector<std::string>& words);

/// Columns whose names differ in one number, or in the joint's name.
struct ColumnFamily {
  std::string pattern;               ///< with {n}, {i} or {joint}; a single column's name
  std::vector<std::size_t> columns;  ///< of the table, in the order of the joints
  std::vector<std::string> words;    ///< of the pattern, without the number
};

/// Names of joints that stand in brackets behind a word for positions: "position[elbow]"; empty:
/// there are none.
std::vector<std::string> bracketed_names(const std::vector<std::string>& columns);

/// Sorts columns into families: as many columns of one as can be.
/// @param joints  names; may be empty
std::vector<ColumnFamily> column_families(const std::vector<std::string>& columns,
                                          const std::vector<std::string>& joints);

}  // namespace dyngen::runtime
