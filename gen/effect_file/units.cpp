// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/effect_file/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

namespace dyngen {
namespace {

struct Factor {
  std::string word;
  int power = 1;
};
using Factors = std::vector<Factor>;

struct UnitWord {
  std::string_view word;
  Dimension dimension;
};
constexpr std::array<UnitWord, 10> kWords = {{{"1", {0, 0, 0, 0}},
                                              {"rad", {0, 0, 0, 0}},
                                              {"kg", {1, 0, 0, 0}},
                                              {"m", {0, 1, 0, 0}},
                                              {"s", {0, 0, 1, 0}},
                                              {"K", {0, 0, 0, 1}},
                                              {"N", {1, 1, -2, 0}},
                                              {"J", {1, 2, -2, 0}},
                                              {"W", {1, 2, -3, 0}},
                                              {"Hz", {0, 0, -1, 0}}}};

/// The words that depend on the joint, in those that do not.
Factors resolved(const Factor& factor, JointUnits joint) {
  const bool revolute = joint == JointUnits::kRevolute;
  const std::string length = revolute ? "rad" : "m";
  Factors words;
  if (factor.word == "position") words = {{length, 1}};
  if (factor.word == "rate") words = {{length, 1}, {"s", -1}};
  if (factor.word == "acceleration") words = {{length, 1}, {"s", -2}};
  if (factor.word == "torque") words = revolute ? Factors{{"N", 1}, {"m", 1}} : Factors{{"N", 1}};
  if (words.empty()) words = {{factor.word, 1}};
  for (Factor& word : words) word.power *= factor.power;
  return words;
}

std::optional<Factors> factors_of(std::string_view unit, JointUnits joint) {
  Factors result;
  int sign = 1;
  while (true) {
    const std::size_t end = std::min(unit.find_first_of("./"), unit.size());
    const std::string_view piece = unit.substr(0, end);
    const std::size_t hat = std::min(piece.find('^'), piece.size());
    Factor factor{std::string(piece.substr(0, hat)), 1};
    if (hat < piece.size()) {
      const std::string_view digits = piece.substr(hat + 1);
      const auto [stop, error] =
          std::from_chars(digits.data(), digits.data() + digits.size(), factor.power);
      if (error != std::errc() || stop != digits.data() + digits.size()) return std::nullopt;
    }
    factor.power *= sign;
    for (Factor& word : resolved(factor, joint)) {
      const bool known = std::any_of(kWords.begin(), kWords.end(), [&](const UnitWord& entry) {
        return entry.word == word.word;
      });
      if (!known) return std::nullopt;
      result.push_back(std::move(word));
    }
    if (end == unit.size()) return result;
    sign = unit[end] == '/' ? -1 : 1;
    unit.remove_prefix(end + 1);
  }
}

}  // namespace

Dimension operator+(const Dimension& a, const Dimension& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
}
Dimension operator-(const Dimension& a, const Dimension& b) { return a + b * -1.0; }
Dimension operator*(const Dimension& a, double power) {
  return {a[0] * power, a[1] * power, a[2] * power, a[3] * power};
}

std::optional<Dimension> dimension_of(std::string_view unit, JointUnits joint) {
  const std::optional<Factors> factors = factors_of(unit, joint);
  if (!factors) return std::nullopt;
  Dimension result{};
  for (const Factor& factor : *factors) {
    const auto found = std::find_if(kWords.begin(), kWords.end(), [&](const UnitWord& entry) {
      return entry.word == factor.word;
    });
    result = result + found->dimension * factor.power;
  }
  return result;
}

std::string unit_text(std::string_view unit, JointUnits joint) {
  const std::optional<Factors> factors = factors_of(unit, joint);
  if (!factors) return std::string(unit);
  Factors merged;
  for (const Factor& factor : *factors) {
    if (factor.word == "1") continue;
    const auto found = std::find_if(merged.begin(), merged.end(),
                                    [&](const Factor& other) { return other.word == factor.word; });
    if (found == merged.end()) {
      merged.push_back(factor);
    } else {
      found->power += factor.power;
    }
  }
  std::string above, below;
  const auto add = [](std::string& text, const Factor& factor, int power) {
    text += (text.empty() ? "" : " ") + factor.word;
    if (power > 1) text += fmt::format("^{}", power);
  };
  int divisors = 0;
  for (const Factor& factor : merged) {
    if (factor.power > 0) add(above, factor, factor.power);
    if (factor.power < 0) {
      add(below, factor, -factor.power);
      ++divisors;
    }
  }
  if (below.empty()) return above.empty() ? "1" : above;
  return (above.empty() ? "1" : above) + (divisors > 1 ? "/(" + below + ")" : "/" + below);
}

std::string dimension_text(const Dimension& dimension) {
  constexpr std::array<std::string_view, 4> kNames = {"kg", "m", "s", "K"};
  std::string text;
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    if (dimension[k] == 0) continue;
    text += (text.empty() ? "" : " ") + std::string(kNames[k]);
    if (dimension[k] != 1) text += fmt::format("^{}", dimension[k]);
  }
  return text.empty() ? "a pure number" : text;
}

}  // namespace dyngen
