// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace dyngen::runtime {

/// A number that accepts, rejects or ranks something in a diagnosis, with what it means.
struct DecisionRule {
  double value = 0;
  std::string_view name;     ///< "noise.slow_part_price": as a file of rules has it
  std::string_view unit;     ///< "1" of a ratio or a count
  std::string_view meaning;  ///< one sentence
  std::string_view source;   ///< a distribution, a paper, or the study that it was measured by

  operator double() const { return value; }  // NOLINT(google-explicit-constructor): it is a number
};

}  // namespace dyngen::runtime
