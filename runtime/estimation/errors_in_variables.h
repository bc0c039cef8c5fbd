// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/estimation/least_squares.h"
#include "runtime/estimation/torque_factor.h"

namespace dyngen::runtime {

/// The covariance that noise of the regressor adds to an estimate of least squares. Its bias has a
/// known shape but not a known size: the estimate has to stand for the truth in it.
///
/// With G = W'W of the weighted regressor, C = E[dW'dW] of its noise, and directions v_k with
/// v'Gv = 1 and v'Cv = kappa_k, a component a of the truth is estimated as (1 - kappa) a. The
/// bias is kappa / (1 - kappa) times the estimated component, and the covariance is the sum of
/// v b^2 v' over all directions. kappa is taken at the upper end of its 95 % interval, since noise
/// of N equations has a chi-square distribution of N degrees. Where that reaches 1, acceleration
/// cannot be told from its noise: b is then the norm of all torque.
///
/// @param estimate  beta, joint_weights, scale and unseen are read
/// @param noise     as for measure_trust(): R'R = C; empty joints: none is known, and nothing added
/// @return (nb x nb)
/// Source: Fuller, "Measurement Error Models", 1987, section 1.1 (attenuation and reliability).
Eigen::MatrixXd errors_in_variables(const TorqueFactor& factor, const Estimate& estimate,
                                    const TorqueFactor& noise);

}  // namespace dyngen::runtime
