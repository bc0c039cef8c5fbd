// SPDX-License-Identifier: MIT
#include "runtime/recordings/units.h"

#include <array>
#include <numbers>

#include "runtime/recordings/columns.h"

namespace dyngen::runtime {
namespace {

struct NamedUnit {
  std::string_view name;
  UnitConversion conversion;
  MotionKind kind = MotionKind::kAngle;  ///< of positions and torques
};

constexpr double kRadPerTurn = 2 * std::numbers::pi;

constexpr std::array<NamedUnit, 13> kTimes = {{{"s", {}},
                                               {"ms", {1, 1e3}},
                                               {"us", {1, 1e6}},
                                               {"ns", {1, 1e9}},
                                               {"min", {60, 1}},
                                               {"sec", {}},
                                               {"msec", {1, 1e3}},
                                               {"usec", {1, 1e6}},
                                               {"nsec", {1, 1e9}},
                                               {"second", {}},
                                               {"millisecond", {1, 1e3}},
                                               {"microsecond", {1, 1e6}},
                                               {"nanosecond", {1, 1e9}}}};

constexpr std::array<NamedUnit, 17> kLengths = {{{"rad", {}},
                                                 {"radian", {}},
                                                 {"mrad", {1, 1e3}},
                                                 {"urad", {1, 1e6}},
                                                 {"deg", {std::numbers::pi, 180}},
                                                 {"degree", {std::numbers::pi, 180}},
                                                 {"turn", {kRadPerTurn, 1}},
                                                 {"rev", {kRadPerTurn, 1}},
                                                 {"arcmin", {std::numbers::pi, 10800}},
                                                 {"arcsec", {std::numbers::pi, 648000}},
                                                 {"m", {}, MotionKind::kLength},
                                                 {"dm", {1, 10}, MotionKind::kLength},
                                                 {"cm", {1, 100}, MotionKind::kLength},
                                                 {"mm", {1, 1e3}, MotionKind::kLength},
                                                 {"um", {1, 1e6}, MotionKind::kLength},
                                                 {"meter", {}, MotionKind::kLength},
                                                 {"metre", {}, MotionKind::kLength}}};

constexpr std::array<NamedUnit, 13> kTorques = {{{"nm", {}},
                                                 {"mnm", {1, 1e3}},
                                                 {"unm", {1, 1e6}},
                                                 {"knm", {1e3, 1}},
                                                 {"ncm", {1, 100}},
                                                 {"nmm", {1, 1e3}},
                                                 {"n", {}, MotionKind::kLength},
                                                 {"mn", {1, 1e3}, MotionKind::kLength},
                                                 {"kn", {1e3, 1}, MotionKind::kLength},
                                                 {"newton", {}, MotionKind::kLength},
                                                 {"newtonmeter", {}},
                                                 {"newtonmetre", {}},
                                                 {"j/rad", {}}}};

constexpr std::array<NamedUnit, 4> kTemperatures = {
    {{"c", {}}, {"degc", {}}, {"celsius", {}}, {"k", {1, 1, -273.15}}}};

template <std::size_t kSize>
std::optional<NamedUnit> find_unit(const std::array<NamedUnit, kSize>& units,
                                   std::string_view word) {
  for (const NamedUnit& unit : units) {
    if (unit.name == word) return unit;
  }
  if (word.size() > 3 && word.back() == 's')
    return find_unit(units, word.substr(0, word.size() - 1));
  return std::nullopt;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

/// A rate of a length: "deg/s" of power 1, "deg/s2" of power 2.
std::optional<NamedUnit> rate_unit(std::string_view word, int power) {
  if (power == 1 && (word == "rpm" || word == "1/min")) return NamedUnit{word, {kRadPerTurn, 60}};
  const std::array<std::string_view, 4> first = {"/s", "ps", "s-1", "/min"};
  const std::array<std::string_view, 4> second = {"/s2", "/s/s", "s-2", "/(s2)"};
  for (const std::string_view end : power == 1 ? first : second) {
    if (word.size() <= end.size() || !word.ends_with(end)) continue;
    std::optional<NamedUnit> length = find_unit(kLengths, word.substr(0, word.size() - end.size()));
    if (length && end == "/min") length->conversion.divisor *= 60;
    if (length) return length;
  }
  return std::nullopt;
}

std::optional<NamedUnit> named_unit(std::string_view word, ColumnQuantity quantity) {
  word = without_brackets(word);
  // "MNm" would be a million N m; nobody means that, and nobody should get a thousandth of it.
  if (word.empty() || (quantity == ColumnQuantity::kTorque && word.front() == 'M'))
    return std::nullopt;
  const std::string normal = plain_unit(word);
  switch (quantity) {
    case ColumnQuantity::kTime:
      return find_unit(kTimes, normal);
    case ColumnQuantity::kPosition:
      return find_unit(kLengths, normal);
    case ColumnQuantity::kVelocity:
      return rate_unit(normal, 1);
    case ColumnQuantity::kAcceleration:
      return rate_unit(normal, 2);
    case ColumnQuantity::kTorque:
      return find_unit(kTorques, normal);
    case ColumnQuantity::kTemperature:
      return find_unit(kTemperatures, normal);
  }
  return std::nullopt;
}

}  // namespace

std::string_view without_brackets(std::string_view word) {
  word = trimmed(word);
  if (word.size() < 2) return word;
  constexpr std::array<std::string_view, 4> kPairs = {"[]", "()", "<>", "{}"};
  for (const std::string_view pair : kPairs) {
    if (word.front() == pair[0] && word.back() == pair[1]) {
      return trimmed(word.substr(1, word.size() - 2));
    }
  }
  return word;
}

std::string plain_unit(std::string_view word) {
  std::string text(without_brackets(word));
  constexpr std::array<std::array<std::string_view, 2>, 12> kSigns = {{{"\xC2\xB0", "deg"},
                                                                       {"\xC2\xBA", "deg"},
                                                                       {"\xC2\xB5", "u"},
                                                                       {"\xCE\xBC", "u"},
                                                                       {"\xC2\xB2", "2"},
                                                                       {"\xC2\xB7", ""},
                                                                       {"\xE2\x8B\x85", ""},
                                                                       {"\xE2\x80\xA2", ""},
                                                                       {"\xB0", "deg"},
                                                                       {"\xB5", "u"},
                                                                       {"\xB2", "2"},
                                                                       {"\xB7", ""}}};
  for (const auto& [from, to] : kSigns) replace_all(text, from, to);
  std::string normal;
  for (const char c : text) {
    if (is_blank(c) || c == '*' || c == '.' || c == '_' || c == '^') continue;
    normal += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  replace_all(normal, "n-m", "nm");
  replace_all(normal, "/sec", "/s");
  return normal;
}

std::optional<UnitConversion> unit_conversion(std::string_view word, ColumnQuantity quantity) {
  const std::optional<NamedUnit> unit = named_unit(word, quantity);
  return unit ? std::optional(unit->conversion) : std::nullopt;
}

std::optional<MotionKind> motion_kind(std::string_view word, ColumnQuantity quantity) {
  if (quantity == ColumnQuantity::kTime || quantity == ColumnQuantity::kTemperature)
    return std::nullopt;
  const std::optional<NamedUnit> unit = named_unit(word, quantity);
  return unit ? std::optional(unit->kind) : std::nullopt;
}

std::string_view known_units(ColumnQuantity quantity) {
  switch (quantity) {
    case ColumnQuantity::kTime:
      return "s, ms, us, ns or min";
    case ColumnQuantity::kPosition:
      return "rad, deg, turn, m, mm or the like";
    case ColumnQuantity::kVelocity:
      return "rad/s, deg/s, rpm, m/s, mm/s or the like";
    case ColumnQuantity::kAcceleration:
      return "rad/s^2, deg/s^2, m/s^2, mm/s^2 or the like";
    case ColumnQuantity::kTorque:
      return "N m, mN m, N mm, N cm, kN m, N, mN or kN";
    case ColumnQuantity::kTemperature:
      return "C or K";
  }
  return {};
}

}  // namespace dyngen::runtime
