// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/support/numeric_robot.h"

/// The judge: robot dynamics with numbers only, written apart from the generator.
///
/// Spatial (six-component) vectors, all of them expressed in frame 0 at its origin, so that no
/// frame-to-frame recursion is needed: a link adds its joint's screw to its parent's motion.
/// Both DH conventions are taken as they are, without re-framing. Source: Featherstone, "Rigid Body
/// Dynamics Algorithms", 2008, ch. 2 and 5 (there in link coordinates).
///
/// `Scalar` is double or long double. q, dq, ddq and results have one entry per joint of the robot;
/// a fixed joint (sigma 2) has entries too: its inputs are ignored, its outputs are 0.
/// Units: rad, N m for revolute joints; m, N for prismatic ones.
/// All throw std::invalid_argument if a vector's length is not the number of joints, if a parent
/// does not stand before its child, or if sigma is not 0, 1 or 2.
namespace dyngen::test {

template <typename Scalar>
using Transform = Eigen::Matrix<Scalar, 4, 4>;
template <typename Scalar>
using SquareMatrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// Frame of every joint in frame 0: the k-th element belongs to joint k + 1.
template <typename Scalar>
std::vector<Transform<Scalar>> forward_kinematics(const NumericRobot& robot,
                                                  const std::vector<Scalar>& q);

/// M ddq + c + g of the links alone: no rotor inertia, no friction, no offset.
template <typename Scalar>
std::vector<Scalar> id_rigid(const NumericRobot& robot, const std::vector<Scalar>& q,
                             const std::vector<Scalar>& dq, const std::vector<Scalar>& ddq);

/// M ddq + c + g + IA ddq + Fs sign(dq) + Fv dq + off, with sign(0) = 0.
template <typename Scalar>
std::vector<Scalar> id(const NumericRobot& robot, const std::vector<Scalar>& q,
                       const std::vector<Scalar>& dq, const std::vector<Scalar>& ddq);

/// g(q): the torque that holds the arm.
template <typename Scalar>
std::vector<Scalar> gravity(const NumericRobot& robot, const std::vector<Scalar>& q);

/// c(q, dq): Coriolis and centrifugal torque.
template <typename Scalar>
std::vector<Scalar> coriolis(const NumericRobot& robot, const std::vector<Scalar>& q,
                             const std::vector<Scalar>& dq);

/// Fs sign(dq) + Fv dq + off: all that is neither inertia nor gravity.
template <typename Scalar>
std::vector<Scalar> friction(const NumericRobot& robot, const std::vector<Scalar>& dq);

/// M(q) of the links alone, column by column from id_rigid.
template <typename Scalar>
SquareMatrix<Scalar> rigid_mass_matrix(const NumericRobot& robot, const std::vector<Scalar>& q);

/// M(q) with IA on the diagonal.
template <typename Scalar>
SquareMatrix<Scalar> mass_matrix(const NumericRobot& robot, const std::vector<Scalar>& q);

}  // namespace dyngen::test
