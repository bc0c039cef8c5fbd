// SPDX-License-Identifier: MIT
#include "runtime/import/signal_units.h"

#include "runtime/recordings/columns.h"

namespace dyngen::runtime {

std::optional<SignalUnit> signal_unit(std::string_view word, ColumnQuantity quantity) {
  if (const auto plain = unit_conversion(word, quantity)) return SignalUnit{RawKind::kSi, *plain};
  const std::string_view inside = without_brackets(word);
  const std::string unit = plain_unit(inside);
  const bool counts = unit == "counts" || unit == "count" || unit == "ticks";
  const bool count_rate = unit == "counts/s" || unit == "ticks/s";
  if ((quantity == ColumnQuantity::kPosition && counts) ||
      (quantity == ColumnQuantity::kVelocity && count_rate)) {
    return SignalUnit{RawKind::kCounts, {}};
  }
  if (quantity == ColumnQuantity::kTorque) {
    if (unit == "a" || unit == "ampere" || unit == "amp") return SignalUnit{RawKind::kCurrent, {}};
    // "MA" would be a million amperes
    if (unit == "ma" && inside.front() != 'M') {
      return SignalUnit{RawKind::kCurrent, {1, 1e3, 0}};
    }
    if (unit == "%" || unit == "percent") return SignalUnit{RawKind::kPercent, {1, 100, 0}};
  }
  return std::nullopt;
}

std::string known_signal_units(ColumnQuantity quantity) {
  std::string units(known_units(quantity));
  switch (quantity) {
    case ColumnQuantity::kPosition:
      return "rad, deg, rev, counts, m, mm or the like";
    case ColumnQuantity::kVelocity:
      return "rad/s, deg/s, rpm, counts/s, m/s, mm/s or the like";
    case ColumnQuantity::kTorque:
      return "N m, mN m, N mm, N cm, kN m, N, mN, kN, A, mA or %";
    case ColumnQuantity::kTime:
    case ColumnQuantity::kAcceleration:
    case ColumnQuantity::kTemperature:
      break;
  }
  return units;
}

ColumnLabel name_and_unit(std::string_view column) {
  column = trimmed(column);
  if (column.empty()) return {};
  constexpr std::string_view kOpen = "[(<{", kClose = "])>}";
  const std::size_t pair = kClose.find(column.back());
  if (pair == kClose.npos) return {column, {}};
  const std::size_t open = column.rfind(kOpen[pair]);
  if (open == column.npos || open == 0) return {column, {}};
  const std::string_view name = trimmed(column.substr(0, open));
  return {name, column.substr(open + 1, column.size() - open - 2)};
}

}  // namespace dyngen::runtime
