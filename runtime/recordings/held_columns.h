// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// A column that has a new value every few samples only, because its source is slower.
struct HeldColumn {
  Eigen::Index period = 1;  ///< samples from one new value to the next; 1: each is new
  bool pulsed = false;      ///< samples between are 0; else the last value is repeated
};

/// Looks at the lengths of stretches of equal values, and of zeros between single values: one
/// length must be that of kMostAlike of them. A coarse sensor's stretches have all lengths.
/// @param values  (N) of one run
HeldColumn find_held(const Eigen::Ref<const Eigen::VectorXd>& values);

/// Lines through the new values, each in the first of its samples (where pulsed: in its own).
/// @param time  (N) s, increasing
void fill_held(const Eigen::Ref<const Eigen::VectorXd>& time, const HeldColumn& held,
               Eigen::Ref<Eigen::VectorXd> values);

}  // namespace dyngen::runtime
