// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

namespace dyngen::runtime {

/// Chi-square that decides nothing between two effects.
inline constexpr double kTie = 0.5;

/// What the order of effects is decided by.
struct Standing {
  double net = 0;              ///< chi-square reduction less its penalty
  std::size_t parameters = 0;  ///< of the effect
};

/// The tie rule. Effects are ordered by their net chi-square in steps of kTie, so that rounding
/// decides nothing between equal columns. Within a step fewer parameters come first. Callers keep
/// the order of the catalogue between effects that are equal in both.
inline bool comes_before(const Standing& a, const Standing& b) {
  const double first = std::floor(a.net / kTie), second = std::floor(b.net / kTie);
  if (first != second) return first > second;
  return a.parameters < b.parameters;
}

}  // namespace dyngen::runtime
