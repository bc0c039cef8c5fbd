// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace dyngen::test {

/// A link of a robot that was made up, and the joint that carries it.
struct MadeLink {
  std::string name, joint;
  int parent = -1;  ///< link; -1 of the root
  int type = 2;     ///< 0 revolute, 1 prismatic, 2 fixed
  bool continuous = false;
  Eigen::Vector3d xyz = Eigen::Vector3d::Zero(), rpy = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< as written, of any length
  double mass = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();  ///< rpy
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre, in its own axes
  double damping = 0, friction = 0;
};

/// A robot of a random tree: all axes and origins, right angles and others, fixed joints. The same
/// seed gives the same robot. Every moving link has mass.
std::vector<MadeLink> made_robot(unsigned seed);

/// Its URDF; numbers with 17 digits.
std::string urdf_of(const std::vector<MadeLink>& links);

/// Torques of the moving joints in the order of the links, N m or N: plain Newton and Euler of
/// every body in the root's frame, gravity 9.81 m/s^2 along -z, with damping and without dry
/// friction.
std::vector<double> torques_of(const std::vector<MadeLink>& links, const std::vector<double>& q,
                               const std::vector<double>& dq, const std::vector<double>& ddq);

/// The frame of a link in the root's.
Eigen::Isometry3d frame_of(const std::vector<MadeLink>& links, const std::vector<double>& q,
                           int link);

/// Depth first, in the order of the links: where each moving joint of the links comes.
std::vector<int> depth_first(const std::vector<MadeLink>& links);

}  // namespace dyngen::test
