// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/excitation/held_accelerations.h"

namespace dyngen::runtime {

/// How a motion through chosen points is made.
struct ChosenPointsOptions {
  int samples = 600;
  double sample_time = 0.005;  ///< s
  int points = 6;              ///< that are aimed at, one after the other
  double bandwidth_hz = 0.6;   ///< of the critically damped way to a point, and of the filter
  double share = 0.5;          ///< of the ranges in which points are chosen
  int candidates = 30;         ///< sets of points of which the best is taken
  std::uint64_t seed = 1;
};

/// A motion from rest through chosen points, x_{k+1} = A x_k + B K (x_i - x_k), low-pass filtered.
///
/// Points are random within the limits; of several sets that is taken in which the smallest
/// |R e_m| over the parameters m is largest, since the smallest singular value of R is no larger.
/// Then the motion is made smaller until it keeps its limits.
/// Source: thesis "Dynamic estimation for serial manipulators" (1995), section 5.3.
/// @throws std::invalid_argument  if an option is out of range
HeldAccelerations through_chosen_points(const LinearModel& model, const MotionLimits& limits,
                                        const std::vector<int>& parameters,
                                        const ChosenPointsOptions& options);

}  // namespace dyngen::runtime
