// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/plausibility/remark.h"
#include "runtime/recordings/recording.h"

namespace dyngen::runtime {

/// What recorded velocities and accelerations say beside the positions: their scale (a unit, a
/// gear, a rate of time that is wrong, a sign), lags, another joint's column, columns that were not
/// measured. Only of joints that move well above the noise of their positions.
/// @param sample_time  s
std::vector<Remark> derivative_remarks(const Recording& recording, double sample_time);

/// How a column goes with the slope of another one: upper = slope * d(lower)/dt, `lag` later.
struct DerivativeFit {
  bool judged = false;  ///< false: the joint does not move, or the recording is too short
  double correlation = 0;
  double slope = 0;
  double lag = 0;  ///< s
};

/// Of each joint. @param lower, upper  (N x n)
std::vector<DerivativeFit> derivative_fits(const Recording& recording,
                                           const Eigen::MatrixXd& lower,
                                           const Eigen::MatrixXd& upper, double sample_time);

}  // namespace dyngen::runtime
