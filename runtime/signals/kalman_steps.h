// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

// The covariances of kalman_filter.h. Time is counted in samples and noise in standard deviations
// of the measurement: the state is [p, T v, T^2 a], the measurement variance is 1, and one number
// says the rest: ratio = jerk_intensity T^5 / measurement_variance.

namespace dyngen::runtime {

Eigen::Matrix3d kalman_transition();
Eigen::Matrix3d kalman_process_noise(double ratio);

/// A x.
inline Eigen::Vector3d kalman_advance(const Eigen::Vector3d& x) {
  return {x[0] + (x[1] + 0.5 * x[2]), x[1] + x[2], x[2]};
}

/// The state of sample 2 from samples 0, 1 and 2 with no prior: three equations for three unknowns.
struct KalmanStart {
  Eigen::Matrix3d from_samples;  ///< x[2] = from_samples [y0 y1 y2]
  Eigen::Matrix3d covariance;
};
KalmanStart kalman_start(double ratio);

/// One step of the Riccati equation: covariances before and after a measurement, and its gain.
struct KalmanUpdate {
  Eigen::Matrix3d predicted, filtered;
  Eigen::Vector3d gain;
};

/// The updates of samples 3, 4, ... samples-1, until the gain is steady; the last holds from there
/// on.
std::vector<KalmanUpdate> kalman_updates(double ratio, Eigen::Index samples);

inline const KalmanUpdate& update_at(const std::vector<KalmanUpdate>& updates,
                                     Eigen::Index sample) {
  return updates[std::min(static_cast<std::size_t>(sample - 3), updates.size() - 1)];
}

/// What is known of a state.
struct KalmanRetreat {
  Eigen::Vector3d state;
  Eigen::Matrix3d covariance;
};

/// What is known of x[sample] from what is known of the next one and from the measurements up to
/// it, for samples 1 and 0, where the filter has no covariance of its own yet: the sum of their
/// information.
///
/// @param sample  0 or 1      @param y0,y1  the measurements of samples 0 and 1
KalmanRetreat kalman_retreat(double ratio, int sample, double y0, double y1,
                             const KalmanRetreat& next);

}  // namespace dyngen::runtime
