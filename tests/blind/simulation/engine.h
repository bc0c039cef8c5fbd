// SPDX-License-Identifier: MIT
// Rigid-body dynamics by an engine that is not ours.
#pragma once

#include <functional>
#include <string>

#include "tests/blind/simulation/tree.h"

namespace blind {

/// M ddq + bias = generalised force, n coordinates.
struct Dynamics {
  Eigen::MatrixXd M;     ///< (n x n) without armatures, kg m^2
  Eigen::VectorXd bias;  ///< (n) Coriolis, centrifugal and gravity, N m
};

/// One engine with one tree in it. Copies share the engine.
struct Engine {
  std::string name;
  std::function<void(const Eigen::VectorXd& q, const Eigen::VectorXd& dq, Dynamics& result)>
      dynamics;
  /// Generalised force of a motion, (n).
  std::function<Eigen::VectorXd(const Eigen::VectorXd& q, const Eigen::VectorXd& dq,
                                const Eigen::VectorXd& ddq)>
      inverse;
  /// Velocity of a point of a link by dq, (3 x n), axes of the world. point: in the link's frame
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& q, int link, const Eigen::Vector3d& point)>
      jacobian;
  /// Where a point of a link is, in the world, m.
  std::function<Eigen::Vector3d(const Eigen::VectorXd& q, int link, const Eigen::Vector3d& point)>
      place;
  std::function<void(int link, const Inertia& inertia)> set_inertia;
};

Engine mujoco_engine(const Tree& tree);
Engine dart_engine(const Tree& tree);

/// Torque of a motion (q, dq, ddq) for each of these bodies without extent, alone on each link,
/// (n x points n): columns of the inertial parameters, by MuJoCo.
std::function<Eigen::MatrixXd(const Eigen::VectorXd& q, const Eigen::VectorXd& dq,
                              const Eigen::VectorXd& ddq)>
torque_of_each(const Tree& tree, const std::vector<Inertia>& points);

}  // namespace blind
