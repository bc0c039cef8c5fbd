// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/estimation/least_squares.h"
#include "runtime/estimation/noise_model.h"

namespace dyngen::runtime {

/// What is known of the parameters before the data are looked at.
struct Prior {
  Eigen::VectorXd beta;    ///< (nb)
  Eigen::VectorXd stddev;  ///< (nb), positive
};

/// A prior with the standard deviations that a person means by "I know it to `relative`":
/// relative * |beta|, and for a parameter whose value is 0 or small the size at which it makes
/// that part of the torque.
Prior make_prior(const TorqueFactor& factor, const Eigen::VectorXd& joint_weights,
                 const Eigen::VectorXd& beta, double relative);

/// minimise sum_j w_j^2 ||tau_j - Y_j beta||^2 + lambda^2 ||(beta - prior) / stddev||^2.
///
/// lambda = 1 is the estimate of Bayes if the joint weights are 1/sigma; a higher one trusts the
/// prior more. The covariance that fits is ridge_covariance().
/// @param lambda  >= 0       @throws std::invalid_argument
/// Source: the thesis, (4.2); Lawson and Hanson, 1974.
Estimate ridge(const TorqueFactor& factor, const Eigen::VectorXd& joint_weights, const Prior& prior,
               double lambda);

/// Of the ridge estimate: M^-1 (sum w^4 Y'Omega Y + lambda^4 diag(1/stddev^2)) M^-1 with
/// M = sum w^2 Y'Y + lambda^2 diag(1/stddev^2), Omega the covariance of the noise. It holds where
/// the truth is as far from the prior as the prior's standard deviations say, whatever lambda is;
/// with white noise, weights 1/sigma and lambda = 1 it is M^-1.
Eigen::MatrixXd ridge_covariance(const TorqueFactor& factor, const NoiseFactor& noise,
                                 const Eigen::VectorXd& joint_weights, const Prior& prior,
                                 double lambda);

/// A point of the L-curve.
struct LCurvePoint {
  double lambda = 0;
  double residual = 0;   ///< sqrt(sum_j w_j^2 ||tau_j - Y_j beta||^2)
  double deviation = 0;  ///< ||(beta - prior) / stddev||
};

/// The curve over `points` values of lambda, from 1e-4 to 1e4, rising.
std::vector<LCurvePoint> l_curve(const TorqueFactor& factor, const Eigen::VectorXd& joint_weights,
                                 const Prior& prior, int points = 81);

/// The corner of the curve: where log residual over log deviation bends most.
/// Source: Hansen and O'Leary, "The use of the L-curve in the regularization of discrete ill-posed
/// problems", 1993.
double corner(const std::vector<LCurvePoint>& curve);

}  // namespace dyngen::runtime
