// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

/// How large the gain of an LMS estimator may be, and how fast it converges then.
///
/// Symbols of the thesis (1995, section 5.2): Gamma the gain, here diagonal; H_k = Y_k' (nb x n);
/// R = (1/K) sum_k H_k H_k' the regressor correlation. With joint weights, Y_k stands for
/// sqrt(w_j) Y_k,j throughout.
namespace dyngen::runtime {

/// R = (1/K) sum_k Y_k' Y_k (thesis 1995, after eq. 5.2).
///
/// @param W       (K*n x nb) regressors of K samples, sample-major rows, finite
/// @param joints  n >= 1
/// @return        (nb x nb)
/// @throws std::invalid_argument  if n < 1, W is empty, not finite, or its rows are no multiple of
/// n
Eigen::MatrixXd regressor_correlation(const Eigen::MatrixXd& W, int joints);

/// A diagonal gain under which no unit matters: Gamma = fraction / lambda_max(C) * diag(R)^-1, with
/// C = diag(R)^-1/2 R diag(R)^-1/2. The largest eigenvalue of Gamma R is then `fraction`.
///
/// The slow adaptation of thesis 1995, before eq. 5.6, asks sigma_max(K Gamma R) < 1; since R is a
/// mean there, that is a gain so small that a whole run of K samples moves the estimate by less
/// than its error: fraction = 1/K. In the mean, errors decay for any fraction < 2. Neither is
/// enough for every sample: see peak_gain().
///
/// @param R         (nb x nb) symmetric, its diagonal >= 0; a parameter with R_ii = 0 gets gain 0
/// @param fraction  (0, 2)
/// @return          (nb) gains, unit of parameter^2 / torque^2
/// @throws std::invalid_argument  if R is not as described or all zero, or fraction is out of range
Eigen::VectorXd propose_gain(const Eigen::MatrixXd& R, double fraction);

/// The largest eigenvalue of Gamma Y_k' Y_k over the samples of W. Below 2, no sample of the kind
/// seen can enlarge the error (measured by e' Gamma^-1 e), whatever their order.
///
/// @param gain (nb) >= 0     @param W, joints  as for regressor_correlation()
/// @throws std::invalid_argument  as regressor_correlation(), or if gain does not fit
double peak_gain(const Eigen::VectorXd& gain, const Eigen::MatrixXd& W, int joints);

/// The slowest time constant of LMS, sample_time / lambda_min(Gamma R).
///
/// Thesis 1995, eq. 5.6, has the smallest singular value of Gamma R in place of its smallest
/// eigenvalue. The two agree if Gamma is a multiple of the identity; in general the singular value
/// is the smaller one, and the error decays no slower than the thesis says.
///
/// @param gain (nb) > 0   @param R (nb x nb) symmetric   @param sample_time s, > 0
/// @return s; infinite if R is singular
/// @throws std::invalid_argument  if a size or sign is wrong
double slowest_time_constant(const Eigen::VectorXd& gain, const Eigen::MatrixXd& R,
                             double sample_time);

}  // namespace dyngen::runtime
