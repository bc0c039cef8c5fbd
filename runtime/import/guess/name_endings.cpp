// SPDX-License-Identifier: MIT
#include "runtime/import/guess/name_endings.h"

#include <array>

#include "runtime/import/signal_units.h"

namespace dyngen::runtime {
namespace {

struct KnownEnding {
  std::string_view word, unit;
};

// In small letters, with '_' between words. An ending stands before those that are its own end.
// "m" is left out, which is a motor or a moment as often as metres, and "n" and "a" too.
constexpr std::array<KnownEnding, 62> kEndings = {{{"rad_per_s2", "rad/s^2"},
                                                   {"deg_per_s2", "deg/s^2"},
                                                   {"m_per_s2", "m/s^2"},
                                                   {"rad_s2", "rad/s^2"},
                                                   {"deg_s2", "deg/s^2"},
                                                   {"mm_s2", "mm/s^2"},
                                                   {"m_s2", "m/s^2"},
                                                   {"radps2", "rad/s^2"},
                                                   {"degps2", "deg/s^2"},
                                                   {"mmps2", "mm/s^2"},
                                                   {"mps2", "m/s^2"},
                                                   {"rad_per_sec", "rad/s"},
                                                   {"deg_per_sec", "deg/s"},
                                                   {"rad_per_s", "rad/s"},
                                                   {"deg_per_s", "deg/s"},
                                                   {"mm_per_s", "mm/s"},
                                                   {"m_per_s", "m/s"},
                                                   {"rad_sec", "rad/s"},
                                                   {"deg_sec", "deg/s"},
                                                   {"rad_s", "rad/s"},
                                                   {"deg_s", "deg/s"},
                                                   {"mm_s", "mm/s"},
                                                   {"m_s", "m/s"},
                                                   {"radps", "rad/s"},
                                                   {"degps", "deg/s"},
                                                   {"dps", "deg/s"},
                                                   {"mmps", "mm/s"},
                                                   {"mps", "m/s"},
                                                   {"rpm", "rpm"},
                                                   {"mrad", "mrad"},
                                                   {"rad", "rad"},
                                                   {"deg", "deg"},
                                                   {"degree", "deg"},
                                                   {"degrees", "deg"},
                                                   {"rev", "rev"},
                                                   {"turns", "rev"},
                                                   {"counts", "counts"},
                                                   {"ticks", "counts"},
                                                   {"mm", "mm"},
                                                   {"cm", "cm"},
                                                   {"mn_m", "mN m"},
                                                   {"kn_m", "kN m"},
                                                   {"n_m", "N m"},
                                                   {"mnm", "mN m"},
                                                   {"knm", "kN m"},
                                                   {"ncm", "N cm"},
                                                   {"nmm", "N mm"},
                                                   {"nm", "N m"},
                                                   {"amps", "A"},
                                                   {"ma", "mA"},
                                                   {"percent", "%"},
                                                   {"pct", "%"},
                                                   {"degc", "C"},
                                                   {"celsius", "C"},
                                                   {"usec", "us"},
                                                   {"msec", "ms"},
                                                   {"nsec", "ns"},
                                                   {"sec", "s"},
                                                   {"us", "us"},
                                                   {"ms", "ms"},
                                                   {"ns", "ns"},
                                                   {"s", "s"}}};

bool is_small(char c) { return c >= 'a' && c <= 'z'; }
bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }
bool is_number(char c) { return c >= '0' && c <= '9'; }

/// "_ActPos_Deg[{n}]" as "Act_Pos_Deg": without marks and numbers at its end, '_' between words.
std::string plain_name(std::string_view name) {
  std::string text;
  for (std::size_t k = 0; k < name.size(); ++k) {
    if (name[k] == '{') {
      const std::size_t close = name.find('}', k);
      if (close != name.npos) k = close;
      text += '_';
      continue;
    }
    const char c = name[k];
    const bool word = is_small(c) || is_capital(c) || is_number(c);
    // "TauNm" has two words, "mNm" has one
    const bool begins = is_capital(c) && k >= 2 && is_small(name[k - 1]) &&
                        (is_small(name[k - 2]) || is_capital(name[k - 2]));
    if (begins) text += '_';
    text += word ? c : '_';
  }
  const auto is_end = [](char c) { return c == '_' || is_number(c); };
  // the 2 of "rad_s2" is no number of a joint
  const std::string_view squares[] = {"_s2", "ps2"};
  while (!text.empty() && is_end(text.back())) {
    if (text.ends_with(squares[0]) || text.ends_with(squares[1])) break;
    text.pop_back();
  }
  return text;
}

bool is_of_role(std::string_view unit, std::optional<ColumnRole> role) {
  if (!role) {
    if (unit == "%" || unit == "counts" || unit == "A" || unit == "mA") return false;
    return signal_unit(unit, ColumnQuantity::kPosition).has_value() ||
           signal_unit(unit, ColumnQuantity::kVelocity).has_value() ||
           signal_unit(unit, ColumnQuantity::kAcceleration).has_value() ||
           signal_unit(unit, ColumnQuantity::kTorque).has_value();
  }
  switch (*role) {
    case ColumnRole::kTime:
      return unit_conversion(unit, ColumnQuantity::kTime).has_value();
    case ColumnRole::kPosition:
      return signal_unit(unit, ColumnQuantity::kPosition).has_value();
    case ColumnRole::kVelocity:
      return signal_unit(unit, ColumnQuantity::kVelocity).has_value();
    case ColumnRole::kAcceleration:
      return signal_unit(unit, ColumnQuantity::kAcceleration).has_value();
    case ColumnRole::kTorque:
    case ColumnRole::kCurrent:
      return signal_unit(unit, ColumnQuantity::kTorque).has_value();
    case ColumnRole::kTemperature:
      return unit_conversion(unit, ColumnQuantity::kTemperature).has_value();
    case ColumnRole::kDuty:
    case ColumnRole::kVoltage:
    case ColumnRole::kFlag:
      return false;
  }
  return false;
}

}  // namespace

std::optional<NameEnding> unit_ending(std::string_view name, std::optional<ColumnRole> role) {
  const std::string plain = plain_name(name);
  std::string small = plain;
  for (char& c : small) {
    if (is_capital(c)) c = static_cast<char>(c - 'A' + 'a');
  }
  for (const KnownEnding& known : kEndings) {
    if (!small.ends_with(known.word) || small.size() < known.word.size() + 2) continue;
    const std::size_t begin = small.size() - known.word.size();
    if (small[begin - 1] != '_') continue;
    const std::string ending = plain.substr(begin);
    // mega is never meant, and nobody should get a thousandth of it
    const bool mega = ending.front() == 'M' && known.unit.front() == 'm';
    if (mega || !is_of_role(known.unit, role)) continue;
    return NameEnding{"_" + ending, std::string(known.unit)};
  }
  // one letter alone says it in capitals only
  const bool amperes = plain.ends_with("_A") && is_of_role("A", role);
  if (amperes) return NameEnding{"_A", "A"};
  if (plain.ends_with("_C") && role == ColumnRole::kTemperature) return NameEnding{"_C", "C"};
  return std::nullopt;
}

}  // namespace dyngen::runtime
