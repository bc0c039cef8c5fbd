// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// The motion of a joint as a Kalman filter sees it: jerk is white noise, the position is measured.
///
///     x = [position, velocity, acceleration],  x[k+1] = A x[k] + w[k],  y[k] = [1 0 0] x[k] + e[k]
///     A = [1 T T^2/2; 0 1 T; 0 0 1]
///     Q = cov w = jerk_intensity [T^5/20 T^4/8 T^3/6; T^4/8 T^3/3 T^2/2; T^3/6 T^2/2 T]
struct KalmanOptions {
  double jerk_intensity = 0;  ///< spectral density of the jerk, (rad/s^3)^2 s = rad^2/s^5; > 0
  double measurement_variance = 0;  ///< of y, rad^2; > 0. An encoder: encoder_variance(step)

  /// @throws std::invalid_argument  if one of them is not positive and finite
  void validate() const;
};

/// Variance of the error of rounding to whole steps: step^2/12.
double encoder_variance(double step);

/// Columns: position, velocity, acceleration; one row a sample.
struct KalmanStates {
  Eigen::Matrix<double, Eigen::Dynamic, 3> states;
  Eigen::Matrix<double, Eigen::Dynamic, 3> variances;  ///< what the filter thinks of its errors
  double log_likelihood = 0;  ///< of all innovations, the first three samples apart
};

/// The estimate of each sample from the samples up to it. Starts from the data: the first three
/// samples give the state of the third, as a diffuse prior would, and through it of the first two.
/// The gain is iterated with the Riccati equation from there until it does not change, then kept.
/// Covariances are updated in Joseph's form, with time counted in samples and noise in standard
/// deviations.
///
/// @param y            (N) positions, N >= 3, finite      @param sample_time  T, s, > 0
/// @return             (N x 3) states and variances
/// @throws std::invalid_argument  if N < 3, or options or sample_time are not valid
KalmanStates kalman_filter(const Eigen::VectorXd& y, double sample_time,
                           const KalmanOptions& options);

/// The estimate of each sample from all samples (Rauch, Tung and Striebel 1965): no phase, and
/// smaller errors. Arguments and failures as those of kalman_filter.
KalmanStates kalman_smoother(const Eigen::VectorXd& y, double sample_time,
                             const KalmanOptions& options);

/// The gain of the filter in the steady state: x[k|k] = x[k|k-1] + gain (y[k] - position).
Eigen::Vector3d steady_gain(double sample_time, const KalmanOptions& options);

/// The pair of intensities under which the innovations are most likely: jerk_intensity over a
/// logarithmic grid, then refined; measurement_variance by its own maximum for each.
///
/// @param y  (N) positions, N >= 8, finite
/// @return   both zero if y is constant (a joint at rest): nothing to be chosen
/// @throws std::invalid_argument  if N < 8 or sample_time is not positive
KalmanOptions choose_kalman_options(const Eigen::VectorXd& y, double sample_time);

/// The same with a known measurement variance.
double choose_jerk_intensity(const Eigen::VectorXd& y, double sample_time,
                             double measurement_variance);

/// jerk_intensity of choose_kalman_options.
double choose_jerk_intensity(const Eigen::VectorXd& y, double sample_time);

}  // namespace dyngen::runtime
