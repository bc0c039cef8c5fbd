// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// First derivative of uniformly sampled columns by central differences,
/// (x[k+1] - x[k-1]) / (2 T); at the ends one-sided and of the same order,
/// (-3 x[0] + 4 x[1] - x[2]) / (2 T). Exact for a parabola; no phase; at the frequency f its gain
/// is sin(2 pi f T) / (2 pi f T) of the true one. Noise grows as f: filter as well.
///
/// @param columns      (N x n), N >= 3
/// @param sample_time  T, s, > 0
/// @return             (N x n) units of columns per s
/// @throws std::invalid_argument  if N < 3 or sample_time is not positive
Eigen::MatrixXd first_difference(const Eigen::MatrixXd& columns, double sample_time);

/// Second derivative, (x[k+1] - 2 x[k] + x[k-1]) / T^2; at the ends one-sided,
/// (2 x[0] - 5 x[1] + 4 x[2] - x[3]) / T^2. Exact for a parabola, and for a cubic. Noise grows as
/// f^2.
///
/// @param columns      (N x n), N >= 4
/// @throws std::invalid_argument  if N < 4 or sample_time is not positive
Eigen::MatrixXd second_difference(const Eigen::MatrixXd& columns, double sample_time);

}  // namespace dyngen::runtime
