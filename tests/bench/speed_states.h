// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace dyngen::bench {

/// Not a power of two, which would put the rows of a batch on the same cache lines.
inline constexpr std::size_t kStates = 4000;

/// Random states, one after the other: sample k begins at [k * joints].
struct States {
  std::size_t joints = 0;
  std::vector<double> q, dq, ddq, tau;

  [[nodiscard]] std::size_t at(std::size_t k) const { return k * joints; }
};

/// q in +-pi rad, dq in +-3 rad/s, ddq in +-10 rad/s^2, tau in +-20 N m, the same on every run.
States random_states(std::size_t joints);

/// The same numbers as batches have them: element e of sample k at [e * kStates + k].
std::vector<double> joint_major(const std::vector<double>& values, std::size_t joints);

}  // namespace dyngen::bench
