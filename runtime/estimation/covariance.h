// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/estimation/least_squares.h"
#include "runtime/estimation/noise_model.h"

namespace dyngen::runtime {

/// The noise of all joints over all parameters: rows F with F'F = sum_j w_j^4 Y_j' Omega_j Y_j.
/// @param columns  of LinearModel       @return (m x nb)
Eigen::MatrixXd noise_rows(const NoiseFactor& noise, const std::vector<std::vector<int>>& columns,
                           int parameters, const Eigen::VectorXd& joint_weights);

/// A residual is smaller than the noise because parameters were fitted to it: what that takes away
/// follows from the same matrices and is given back. For the fit from which the residual comes.
/// @param scale, unseen  of the estimate
void give_back_fitted_noise(NoiseFactor& noise, const TorqueFactor& factor,
                            const Eigen::VectorXd& joint_weights, const Eigen::VectorXd& scale,
                            const Eigen::MatrixXd& unseen);

/// The covariance of weighted least squares when noise is correlated in time: the sandwich
/// B^-1 (sum w_j^4 F_j'F_j) B^-1 with B = sum w_j^2 Y_j'Y_j.
///
/// @param scale, unseen  of the estimate: directions that are not seen have no part in it
/// Source: Newey and West, 1987, for the sandwich; the middle from an autoregressive process as in
/// Andrews and Monahan, 1992.
Eigen::MatrixXd correlated_covariance(const TorqueFactor& factor, const NoiseFactor& noise,
                                      const Eigen::VectorXd& joint_weights,
                                      const Eigen::VectorXd& scale, const Eigen::MatrixXd& unseen);

/// The textbook formula for white noise, for comparison: sigma_j from each joint's residual.
Eigen::MatrixXd white_covariance(const TorqueFactor& factor, const Eigen::VectorXd& beta,
                                 const Eigen::VectorXd& joint_weights, const Eigen::VectorXd& scale,
                                 const Eigen::MatrixXd& unseen);

/// The t of a 95 % interval beta +- t stddev: Student's, with as many degrees of freedom as samples
/// of the least known joint are worth, less its parameters.
double interval_of(const TorqueFactor& factor, const NoiseFactor& noise);

}  // namespace dyngen::runtime
