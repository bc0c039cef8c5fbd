// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dyngen::runtime {

/// What joints without velocity do next.
struct RestingJoints {
  Eigen::VectorXd ddq;        ///< (n) of all joints
  Eigen::VectorXd held;       ///< (n) torque that friction holds; of joints that stay
  Eigen::VectorXi direction;  ///< (n) of sliding, -1 or 1; 0: the joint stays, or is not at rest
};

/// Finds which of several joints at rest stay where they are, all at once: the one solution of
///
///     M ddq = torque - held,
///     at rest and stays:   ddq = 0, |held| <= coulomb
///     at rest and slides:  held = coulomb * direction, ddq * direction >= 0
///     moves already:       held = 0
///
/// which is unique since M is positive definite (the problem is a linear complementarity problem
/// with a P-matrix). A joint slides only if |held| would exceed coulomb by 1e-10 of it, so that
/// rounding moves nobody. Solved by principal pivoting, the joint of least index first: Murty,
/// "Linear Complementarity, Linear and Nonlinear Programming", 1988.
///
/// @param M        (n x n) symmetric, positive definite
/// @param torque   (n) that accelerates: actuators less gravity, Coriolis, and friction of joints
///                 that move
/// @param coulomb  (n) not negative
/// @param at_rest  (n) true: no velocity, and coulomb is positive
/// @throws std::runtime_error  if M is not positive definite
RestingJoints resting_joints(const Eigen::MatrixXd& M, const Eigen::VectorXd& torque,
                             const Eigen::VectorXd& coulomb,
                             const Eigen::Array<bool, Eigen::Dynamic, 1>& at_rest);

/// ddq of the joints `moving` with M ddq = push; 0 of the others, which friction holds.
/// @throws std::runtime_error  if that part of M is not positive definite
Eigen::VectorXd accelerations(const Eigen::MatrixXd& M, const Eigen::VectorXd& push,
                              const std::vector<Eigen::Index>& moving);

/// As much more than coulomb friction a joint must be pushed to slide.
inline constexpr double kStictionMargin = 1e-10;

}  // namespace dyngen::runtime
