// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/signals/butterworth.h"
#include "runtime/signals/kalman_filter.h"

namespace dyngen::runtime {

/// s until a low-pass remembers a hundredth of an impulse: what the ends of a run deserve.
double filter_trim(const LowPass& filter);

/// The same for the Kalman filter. Its poles are those of a Butterworth filter of order three with
/// the cut-off (jerk_intensity / (measurement_variance T))^(1/6) rad/s.
double kalman_trim(double sample_time, const KalmanOptions& options);

/// Whole samples.
Eigen::Index trim_samples(double seconds, double sample_time);

}  // namespace dyngen::runtime
