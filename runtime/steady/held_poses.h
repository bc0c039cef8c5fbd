// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "runtime/recordings/recording.h"
#include "runtime/rules/steady_rules.h"

namespace dyngen::runtime {

/// A mean torque with its 95 % interval, N m or N.
struct MeanTorque {
  double value = 0, low = 0, high = 0;
};

/// A pose in which a joint was held after it had come from either side. Friction holds with the
/// sign of the last motion, or less: it cannot be known how much of it.
struct HeldPair {
  Eigen::VectorXd q;                   ///< (n) rad or m
  int from_below = 0, from_above = 0;  ///< stretches
  MeanTorque below, above;
  MeanTorque gravity;   ///< half of the sum
  MeanTorque friction;  ///< half of the difference: what friction held back, at least
};

struct HeldPairs {
  std::vector<HeldPair> pairs;
  int one_sided = 0;  ///< poses that were reached from one side alone
};

/// @param joint  from 0
HeldPairs held_pairs(const std::vector<std::shared_ptr<const Recording>>& recordings,
                     Eigen::Index joint, const SteadyRules& rules);

}  // namespace dyngen::runtime
