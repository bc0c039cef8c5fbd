// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dyngen::runtime {

/// Covariance of (e_t - e_(t - kP)) / sqrt(2) of one run, at lags from 0.
struct PeriodDifference {
  double period = 0;           ///< P, samples
  int apart = 1;               ///< k
  Eigen::VectorXd covariance;  ///< (lags)
  double pairs = 0;            ///< of samples
};

/// Noise that outlasts a period, as 1/f noise does: its neighbouring periods are alike, their
/// difference has less of it than the noise has, and periods further apart differ more. Its
/// covariance is taken to be
///
///     s(t) = w (exp(-2 t/P) + exp(-t/2P) + exp(-t/8P)),
///
/// which is nearly 1/f about 1/P; w from what differences over k periods are more than those over
/// one.
/// @param differences  of one joint
/// @return w as a part of the variance of the differences over one period; 0 where nothing is apart
/// by more
double lasting_part(const std::vector<PeriodDifference>& differences);

/// What differences over one period lack of the covariance of noise with that part: (lags).
Eigen::VectorXd lasting_covariance(const std::vector<PeriodDifference>& differences, double part);

}  // namespace dyngen::runtime
