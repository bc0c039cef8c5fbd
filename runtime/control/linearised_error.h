// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <complex>

#include "runtime/control/gains.h"

/// What a wrong model does to computed torque, offline.
///
/// The plant has the inertia M, the controller's model M_hat. With tau = M_hat (ddq_ref + Kd e' +
/// Kp e) + h_hat and tau = M ddq + h the error obeys
///
///     e'' + (I + E)(Kd e' + Kp e) = -E ddq_ref + M^-1 (h - h_hat),     E = M^-1 M_hat - I,
///
/// (n x n), constant at a posture. The right side drives the error; the left side decides whether
/// it stays bounded. Changes of h - h_hat with q and dq are left out, so the statements below hold
/// for small errors about a posture at which the robot stands or moves slowly.
///
/// s is an eigenvalue if P(s) + E C(s) is singular, where P = diag(s^2 + kd s + kp) and
/// C = diag(kd s + kp). Block Gerschgorin theorem: Feingold and Varga, "Block diagonally dominant
/// matrices and generalizations of the Gerschgorin circle theorem", 1962; it is applied to this
/// matrix at every s, with a joint as a block. That Egeland evaluates computed torque in this way
/// is reported by the thesis "Dynamic estimation for serial manipulators" (1995), section 2.5.
namespace dyngen::runtime {

/// E = M^-1 M_hat - I. M must be symmetric and positive definite.
/// @throws std::invalid_argument  if the sizes differ or M is not positive definite
Eigen::MatrixXd inertia_error(const Eigen::MatrixXd& M, const Eigen::MatrixXd& M_hat);

/// The 2 n eigenvalues of the error dynamics, 1/s. All in the left half plane: errors decay.
/// @param gains  of computed torque          @throws std::invalid_argument  if the sizes differ
Eigen::VectorXcd error_eigenvalues(const Gains& gains, const Eigen::MatrixXd& E);

/// How far s is inside the region of joint j: sum_k bound_jk |c_k(s)| - |p_j(s)|. Every eigenvalue
/// of every E with |E_jk| <= bound_jk is in the region of some joint, where this is not negative.
/// @param bound  (n x n) not negative        @param joint  from 0
double inclusion_margin(const Gains& gains, const Eigen::MatrixXd& bound, int joint,
                        std::complex<double> s);

/// The largest of inclusion_margin() over the joints: negative where no eigenvalue can be.
double inclusion_margin(const Gains& gains, const Eigen::MatrixXd& bound, std::complex<double> s);

/// What a setting of gains survives.
struct SurvivedError {
  /// Errors decay for every E with ||E||_2 (the largest singular value) below this; 1 is an inertia
  /// that is wrong by its own size.
  double norm = 0;
  int joint = 0;     ///< from 0: whose gains decide
  double speed = 0;  ///< rad/s: of the oscillation that begins there
};

/// The largest model error that leaves the loop stable: 1 / max over joints and frequencies of
/// |c_j(i w) / p_j(i w)|, in closed form. (If P + E C is singular, so is P C^-1 + E, and ||E|| is
/// at least the smallest |p_j / c_j|.) With equal gains at two joints or more there is an E of this
/// norm that does oscillate: a rotation in the plane of two joints.
/// @throws std::invalid_argument  if a gain is not positive
SurvivedError largest_survived_error(const Gains& gains);

/// The slowest decay that is certain with ||E||_2 <= norm: every eigenvalue has a real part of at
/// most -decay, 1/s. 0 if norm is not survived.
/// @throws std::invalid_argument  if a gain is not positive or norm is negative
double guaranteed_decay(const Gains& gains, double norm);

}  // namespace dyngen::runtime
