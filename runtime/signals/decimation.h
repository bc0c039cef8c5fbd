// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// What a parallel filter of some samples for one is like.
struct FilterShape {
  /// Of the new Nyquist frequency, 0.5 .. 0.95: up to there the gain is 1 within a thousandth, and
  /// nothing above folds onto it: the stop band, of 60 dB, begins at (2 - pass) times the new
  /// Nyquist frequency.
  double pass = 0.8;
  /// Instead of that so many moving averages over the samples for one, one behind another; 0, or an
  /// even number up to 8. Short, and with zeros of that order wherever something folds onto what is
  /// slow: for noise of accelerations, which grows with the square of frequency, and for equations
  /// near stretches that are left out.
  int averages = 0;
};

/// A symmetric (so without phase) low-pass FIR filter that keeps one sample of `factor`: the
/// parallel filter. Torque and every column of the regressor pass the same linear operator, so tau
/// = W beta holds after it as it did before, whatever the filter takes away (Gautier 1997).
struct Decimator {
  Eigen::VectorXd taps;     ///< odd number, symmetric, sum 1
  Eigen::Index factor = 1;  ///< samples in for one out
  FilterShape shape;
};

/// Windowed sinc (Kaiser's window), -6 dB at the new Nyquist frequency; or moving averages.
/// @param factor  >= 1; 1 passes everything as it is
/// @throws std::invalid_argument  if the factor or a number of the shape is out of its range
/// Source: Kaiser 1974 (length and window); Hogenauer, "An economical class of digital filters for
/// decimation and interpolation", IEEE ASSP 1981 (moving averages).
Decimator design_decimator(Eigen::Index factor, const FilterShape& shape = {});

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
