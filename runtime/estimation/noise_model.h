// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/estimation/rows.h"

namespace dyngen::runtime {

/// Noise of one joint as an autoregressive process: e_t = sum_k a_k e_(t-k) + white noise.
struct AutoregressiveNoise {
  Eigen::VectorXd coefficients;  ///< a_1 .. a_p; p is chosen, 0 for white noise
  double innovation = 0;         ///< standard deviation of the white noise, N m or N
  double deviation = 0;          ///< standard deviation of e
  /// How many consecutive samples are worth one independent sample for a mean:
  /// sum over all lags of the autocorrelation.
  double correlation_time = 1;
};

/// Fits an autoregressive process to autocovariances; the order with the least Bayesian information
/// criterion (Schwarz 1978). Akaike's takes longer processes, and intervals that cover 1 % less
/// (docs/explanation/studies.md).
/// @param autocovariance  lags 0 .. L, not all zero       @param samples  how many they come from
/// Source: the Levinson-Durbin recursion on the Yule-Walker equations.
AutoregressiveNoise fit_autoregression(const Eigen::VectorXd& autocovariance, double samples);

/// Of the residual of every joint, over the equations that it has; runs are not joined.
struct ResidualAutocovariance {
  Eigen::MatrixXd lags;     ///< (most_lags + 1 x n), from lag 0; 0 x 0 where there are no samples
  Eigen::VectorXd samples;  ///< (n) equations that each joint has; empty: there are none
};
ResidualAutocovariance residual_autocovariance(const RowSource& source, const Eigen::VectorXd& beta,
                                               Eigen::Index most_lags);

/// What the noise of the torque does to the normal equations: per joint a triangle F with
/// F'F = Y'Omega Y, Omega the covariance of that joint's noise over all samples.
///
/// Merged as equations are: noise of different recordings is independent.
struct NoiseFactor {
  std::vector<Eigen::MatrixXd> F;  ///< (n_j x n_j) of each joint
  Eigen::VectorXd power;           ///< (n) sum of the residual's squares
  /// (n) the same times the correlation time: over power, how many consecutive samples are worth
  /// one.
  Eigen::VectorXd correlated_power;

  [[nodiscard]] Eigen::VectorXd correlation_time() const {
    return correlated_power.array() / power.array().max(1e-300);
  }
};

/// Without any rows. @param columns  of LinearModel
NoiseFactor empty_noise(const std::vector<std::vector<int>>& columns);

/// @param beta  where the residual is taken
/// The rows run through the filter 1 / (1 - sum a_k z^-k), so that F'F is exact for that process,
/// whatever the regressor.
NoiseFactor noise_factor(const RowSource& source, const std::vector<std::vector<int>>& columns,
                         const Eigen::VectorXd& beta);

/// Noise that is known otherwise than from the residual.
struct KnownNoise {
  /// [joint] processes that add up, independent of one another
  std::vector<std::vector<AutoregressiveNoise>> parts;
  Eigen::VectorXd correlation_time;  ///< (n) samples that are worth one
};

/// The same of such noise. @param parameters  of the model, nb
NoiseFactor noise_factor(const RowSource& source, const std::vector<std::vector<int>>& columns,
                         int parameters, const KnownNoise& noise);

/// Adds another recording's. @throws std::invalid_argument  if it is of another model
void merge(NoiseFactor& factor, const NoiseFactor& other);

}  // namespace dyngen::runtime
