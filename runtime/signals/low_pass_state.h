// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/signals/butterworth.h"

namespace dyngen::runtime {

/// Position, velocity and acceleration of one run.
struct LowPassStates {
  Eigen::MatrixXd q, dq, ddq;  ///< (N x n)
};

/// Neighbours on each side that the differences below read.
inline constexpr Eigen::Index kDifferenceReach = 5;

/// First derivative by central differences, exact for polynomials of the tenth degree: of a sine
/// of a fifth of the sampling frequency the gain is 0.998 of the true one, where the difference of
/// two neighbours has 0.757. No phase.
/// @param middle  the sample, kDifferenceReach others on each side of it
double wide_first_difference(const double* middle, double sample_time);
/// Second derivative, of the tenth order too: 0.9996 there, where three samples have 0.875.
double wide_second_difference(const double* middle, double sample_time);

/// The zero-phase filter of the positions and of their differences, wide_first_difference() and
/// wide_second_difference(); of the nearest neighbours alone in runs of fewer than six samples.
/// Linear, so the order does not matter; differences are taken first, because those of filtered
/// positions would bring the rounding of the filter back, divided by T^2. Ends as in zero_phase:
/// the differences are those of the reflected positions.
///
/// @param q  (N x n) one run, uniformly sampled at filter.sample_time; N >= 3
/// @throws std::invalid_argument  if N < 3
LowPassStates low_pass_states(const LowPass& filter, const Eigen::MatrixXd& q);

}  // namespace dyngen::runtime
