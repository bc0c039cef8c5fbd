// SPDX-License-Identifier: MIT
// The machines of the blind suite as a tree of bodies, read from MJCF that is written apart from
// every robot file. Nothing in this folder includes from gen/ or runtime/.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace blind {

struct Inertia {
  double mass = 0;                                      ///< kg
  Eigen::Vector3d com = Eigen::Vector3d::Zero();        ///< in the link's frame, m
  Eigen::Matrix3d about_com = Eigen::Matrix3d::Zero();  ///< axes of the link's frame, kg m^2
};

/// A body and the one joint that carries it. The joint's axis goes through the body's origin.
struct Link {
  std::string name;
  int parent = -1;                                           ///< index, -1: the world
  Eigen::Vector3d position = Eigen::Vector3d::Zero();        ///< in the parent's frame at q = 0, m
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();  ///< from this frame to the parent's
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();           ///< in this frame
  bool slides = false;
  Inertia inertia;
};

/// Links stand after their parents; coordinate i is the joint of link i.
struct Tree {
  std::vector<Link> links;
  Eigen::Vector3d gravity = Eigen::Vector3d(0, 0, -9.81);  ///< m/s^2
};

/// A kind of arm: its geometry, its limits, and the sizes that random machines are drawn around.
/// Vectors have an entry per joint.
struct Arm {
  std::string name;
  Tree tree;                         ///< inertias are 0
  Eigen::VectorXd q_min, q_max;      ///< rad
  Eigen::VectorXd v_max, a_max;      ///< rad/s, rad/s^2
  Eigen::VectorXd mass, size;        ///< kg, m
  Eigen::VectorXd armature;          ///< kg m^2
  Eigen::VectorXd coulomb, viscous;  ///< N m, N m s/rad

  Eigen::Index joints() const { return v_max.size(); }
};

/// @param path  MJCF: one hinge a body; `numeric` rows give the limits and sizes above
/// @throws std::runtime_error with the file's name
Arm read_arm(const std::string& path);

/// The inertia of several bodies as one.
Inertia sum(const std::vector<Inertia>& parts);

}  // namespace blind
