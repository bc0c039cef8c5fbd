// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace dyngen::runtime {

enum class TimeWordKind {
  kInstant,    ///< a date, with or without a time of day
  kTimeOfDay,  ///< hh:mm:ss or mm:ss.fff, without a date
};

struct TimeWord {
  TimeWordKind kind = TimeWordKind::kInstant;
  /// Since 1970-01-01 00:00 UTC (without a zone: as if the clock were UTC), or since midnight.
  std::int64_t nanoseconds = 0;
};

inline constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
inline constexpr std::int64_t kNanosecondsPerDay = 86'400 * kNanosecondsPerSecond;

/// Reads a date and time as programs write them: ISO 8601 (2026-11-28T09:07:10.25+01:00, with a
/// blank or '_' for the T, a comma before the fraction, 20261128T090710Z, a date alone), 2026/11/28
/// 9:07:10, 28.11.2026 09:07:10,250, and with AM or PM 11/28/2026 9:07:10.25 AM; times of day
/// alone (09:07:10.250, 09:07:10:250, 07:10.250). Digits beyond nanoseconds are cut.
///
/// @return nothing if it is none, or before 1700 or after 2250
std::optional<TimeWord> read_time_word(std::string_view word);

}  // namespace dyngen::runtime
