// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/estimation/least_squares.h"

namespace dyngen::runtime {

/// The thesis's measures of how far an estimate can be trusted. Equations are weighted (1/sigma of
/// each joint) and columns scaled to unit norm, so that numbers of different units can be compared.
struct Trust {
  double regressor_noise = 0;  ///< ||dH||, spectral norm, from the noise of the acceleration
  double torque_noise = 0;     ///< ||dT||: the residual's norm
  /// (4.1): bound of ||dB|| over ||B||; infinite where noise may hide the weakest direction.
  double perturbation_bound = 0;
  Eigen::VectorXd
      attenuation;  ///< (5.2), first term: bias by the regressor's noise (nb), own units
  /// (5.2), second term: the largest bias that unmodelled torque of the residual's size could make
  /// (nb), own units.
  Eigen::VectorXd worst_bias;
  double time_constant =
      0;  ///< (5.6) s, of LMS with the gain 1/sigma_max(R) for all scaled parameters
  double singular_value_change = 0;    ///< (5.7): bound of the change of R's singular values
  double smallest_singular_value = 0;  ///< of R = W'W / K, for (5.7)
  /// Relative parameter error in the worst case over relative unmodelled torque,
  /// ||T|| / (sigma_min ||B||), dimensionless: how much an error that looks like a parameter is
  /// magnified.
  double bias_susceptibility = 0;
};

/// @param regressor_noise  equations whose rows are what acceleration noise adds to the regressor
/// (torque 0): R'R = sum of dH'dH; empty joints: no noise known
/// @param sample_time  s, between the rows of the fit
/// Source: the thesis, (4.1), (5.2), (5.6), (5.7), after Lawson and Hanson 1974 and Armstrong.
Trust measure_trust(const TorqueFactor& factor, const Estimate& estimate,
                    const TorqueFactor& regressor_noise, double sample_time);

}  // namespace dyngen::runtime
