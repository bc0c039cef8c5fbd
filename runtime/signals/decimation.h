// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// A symmetric (so without phase) low-pass FIR filter that keeps one sample of `factor`: the
/// parallel filter. Torque and every column of the regressor pass the same linear operator, so tau
/// = W beta holds after it as it did before, whatever the filter takes away (Gautier 1997).
struct Decimator {
  Eigen::VectorXd taps;        ///< odd number, symmetric, sum 1
  Eigen::Index factor = 1;     ///< samples in for one out
  double pass = 0.8;           ///< of the new Nyquist frequency: up to there the gain is 1
  double attenuation_db = 60;  ///< of the stop band
};

/// Windowed sinc (Kaiser's window), -6 dB at the new Nyquist frequency.
///
/// @param factor          >= 1; 1 passes everything as it is
/// @param pass            in [0.5, 0.95]: up to pass times the new Nyquist frequency the gain is 1
///                        within the ripple, and nothing above folds onto it: the stop band begins
///                        at (2 - pass) times the new Nyquist frequency
/// @param attenuation_db  30..120: of the stop band; the ripple of the pass band is as small
/// @throws std::invalid_argument  if one of them is out of its range
Decimator design_decimator(Eigen::Index factor, double pass = 0.8, double attenuation_db = 60);

/// The input sample that output 0 belongs to, a whole multiple of factor; output k belongs to
/// first_sample + k factor.
Eigen::Index first_sample(const Decimator& decimator);

/// How many outputs N samples give: one for each multiple of factor at which all taps lie inside.
Eigen::Index decimated_samples(const Decimator& decimator, Eigen::Index samples);

/// @param columns  (N x n) one run
/// @return         (decimated_samples(N) x n); no rows if the run is shorter than the taps
Eigen::MatrixXd decimate(const Decimator& decimator,
                         const Eigen::Ref<const Eigen::MatrixXd>& columns);

}  // namespace dyngen::runtime
