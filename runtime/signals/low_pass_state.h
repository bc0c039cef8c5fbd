// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/signals/butterworth.h"

namespace dyngen::runtime {

/// Position, velocity and acceleration of one run.
struct LowPassStates {
  Eigen::MatrixXd q, dq, ddq;  ///< (N x n)
};

/// The zero-phase filter of the positions and of their central differences. Linear, so the order
/// does not matter; differences are taken first, because those of filtered positions would bring
/// the rounding of the filter back, divided by T^2. Ends as in zero_phase: the differences are
/// those of the reflected positions.
///
/// @param q  (N x n) one run, uniformly sampled at filter.sample_time; N >= 3
/// @throws std::invalid_argument  if N < 3
LowPassStates low_pass_states(const LowPass& filter, const Eigen::MatrixXd& q);

/// (x[1] - x[-1]) / (2 T), given neighbours.
inline double central_first(double before, double after, double sample_time) {
  return (after - before) / (2 * sample_time);
}

/// (x[1] - 2 x[0] + x[-1]) / T^2, given neighbours.
inline double central_second(double before, double here, double after, double sample_time) {
  return ((after - here) - (here - before)) / (sample_time * sample_time);
}

}  // namespace dyngen::runtime
