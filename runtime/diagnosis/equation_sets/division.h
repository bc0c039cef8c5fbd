// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "runtime/identification/motion_source.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// Recordings that are fitted, and those that only prove the answer.
struct Division {
  std::vector<MotionSource> train, heldout;
  /// Of each that is fitted the place of the recording that it is a part of; empty: they are whole.
  std::vector<std::size_t> origins{};

  /// @param place  of one that is fitted
  [[nodiscard]] std::size_t origin_of(std::size_t place) const {
    return origins.empty() ? place : origins.at(place);
  }
};

/// A fifth of every recording is held out: the last in which all joints move about as much of the
/// time as in the whole recording, since a joint at standstill proves nothing.
Division divided(const std::vector<MotionSource>& recordings, const EquationRules& rules = {});

}  // namespace dyngen::runtime
