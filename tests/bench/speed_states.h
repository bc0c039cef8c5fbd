// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace dyngen::bench {

inline constexpr std::size_t kStates = 4096;
inline constexpr std::size_t kBatch = 1000;  ///< samples of a batch; a power of two is slower

/// One of the states.
struct Sample {
  const double *q, *dq, *ddq, *tau;
  std::size_t joints;
};

/// The first kBatch states joint by joint, as batch functions read them.
template <typename Scalar>
struct Rows {
  std::vector<Scalar> q, dq, ddq;
};

/// Random states, one after the other: sample k begins at [k * joints].
struct States {
  std::size_t joints = 0;
  std::vector<double> q, dq, ddq, tau;

  [[nodiscard]] Sample sample(std::size_t k) const {
    const std::size_t at = k * joints;
    return {&q[at], &dq[at], &ddq[at], &tau[at], joints};
  }
};

/// q in +-pi rad, dq in +-3 rad/s, ddq in +-10 rad/s^2, tau in +-20 N m, the same on every run.
States random_states(std::size_t joints);

/// From sample after sample to joint after joint, of the first `count` samples.
template <typename Scalar>
std::vector<Scalar> joint_major(const std::vector<double>& values, std::size_t joints,
                                std::size_t count) {
  std::vector<Scalar> result(joints * count);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t j = 0; j < joints; ++j) {
      result[j * count + k] = static_cast<Scalar>(values[k * joints + j]);
    }
  }
  return result;
}

template <typename Scalar>
Rows<Scalar> rows(const States& states, std::size_t count = kBatch) {
  const auto of = [&](const std::vector<double>& values) {
    return joint_major<Scalar>(values, states.joints, count);
  };
  return {of(states.q), of(states.dq), of(states.ddq)};
}

}  // namespace dyngen::bench
