// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// XX XY XZ YY YZ ZZ MX MY MZ M of a body: tensor about the frame's origin, kg m^2 (matrix
/// elements: XY = -integral x y dm), first moments, kg m, mass, kg.
using TenParameters = Eigen::Matrix<double, 10, 1>;

/// alpha, d1, d2, d3, s12, s23, s13, t1, t2, t3: log-Cholesky coordinates of a pseudo-inertia.
using LogCholesky = Eigen::Matrix<double, 10, 1>;

/// The matrix of second moments of mass in homogeneous coordinates, J = integral [x; 1] [x; 1]' dm
/// = [Sigma, h; h', m] with Sigma = tr(I)/2 1 - I.
///
/// A body of positive density that fills a volume has J positive definite, and every positive
/// definite J belongs to such a body. Ten numbers on a line, linear both ways.
/// Source: Wensing, Kim and Slotine, "Linear matrix inequalities for physically consistent inertial
/// parameter identification", 2018.
Eigen::Matrix4d pseudo_inertia(const TenParameters& ten);

/// The inverse of pseudo_inertia(). Reads the upper triangle.
TenParameters ten_parameters(const Eigen::Matrix4d& J);

/// The smallest eigenvalue of the pseudo-inertia. It mixes kg m^2 and kg: only its sign has a
/// meaning of its own. NaN if a parameter is not finite.
double smallest_eigenvalue(const TenParameters& ten);

/// Whether some body has these parameters: smallest_eigenvalue() > 0. False for what has no
/// volume (a point, a rod, a sheet) and if a parameter is not finite.
bool is_consistent(const TenParameters& ten);

/// Upper triangular U with positive diagonal and J = U U'.
/// @throws std::invalid_argument  if J is not positive definite
Eigen::Matrix4d upper_factor(const Eigen::Matrix4d& J);

/// Coordinates of a positive definite pseudo-inertia: J = U U',
///
///     U = exp(alpha) [exp(d1) s12 s13 t1; 0 exp(d2) s23 t2; 0 0 exp(d3) t3; 0 0 0 1].
///
/// Every ten numbers are the coordinates of exactly one consistent body.
/// @throws std::invalid_argument  if J is not positive definite
/// Source: Rucker and Wensing, "Smooth parameterization of rigid-body inertia", IEEE RA-L 2022.
LogCholesky log_cholesky(const Eigen::Matrix4d& J);

/// The inverse of log_cholesky(). Positive definite but for rounding and overflow.
Eigen::Matrix4d from_log_cholesky(const LogCholesky& theta);

/// d ten_parameters(from_log_cholesky(theta)) / d theta, (10 x 10).
Eigen::Matrix<double, 10, 10> log_cholesky_jacobian(const LogCholesky& theta);

}  // namespace dyngen::runtime
