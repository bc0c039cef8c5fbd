// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// A signal that is a finite Fourier series, and its derivatives.
struct SpectralStates {
  Eigen::MatrixXd position;      ///< (N x n) the lines that were kept
  Eigen::MatrixXd velocity;      ///< (N x n)
  Eigen::MatrixXd acceleration;  ///< (N x n)
};

/// Differentiates in the frequency domain data that covers whole periods: N samples are N
/// sample_time of a periodic signal, sample N would be sample 0 again. The lines 0, 1, ...
/// last_line are kept and multiplied by i w and by -w^2. Exact for a Fourier series with no line
/// above; removes no mean. What is not periodic comes back wrong, most of all at the ends.
///
/// @param columns      (N x n), any N >= 1
/// @param sample_time  s, > 0
/// @param last_line    >= 0; line k is k/(N sample_time) Hz; must lie below N/2
/// @throws std::invalid_argument  if one of them is out of its range
SpectralStates spectral_derivatives(const Eigen::MatrixXd& columns, double sample_time,
                                    Eigen::Index last_line);

/// The last line of N samples at or below a frequency in Hz, and below N/2.
Eigen::Index line_below(double cutoff_hz, Eigen::Index samples, double sample_time);

}  // namespace dyngen::runtime
