// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gen/bodies/body_tree.h"

namespace dyngen {

/// Which part of a tree is the robot. Empty names: the root, and no tip.
struct TreePart {
  std::string base;  ///< the body that stands still
  std::string tip;   ///< the body at the end of the chain; empty: everything that hangs on the base
};

/// A body in a group of bodies that do not move against each other.
struct GroupedBody {
  int body = -1;  ///< place in BodyTree::bodies
  Pose pose{};    ///< of the body's frame in the group's
};

/// Bodies that fixed joints join, and the joint that moves them.
struct MovingGroup {
  int joint = -1;         ///< place in BodyTree::joints; -1: the group of the base
  bool reversed = false;  ///< the joint's child carries its parent
  int parent = -1;        ///< group; -1 of the base
  Pose pose{};            ///< of the group's frame in the parent group's, at q = 0
  Vector3 axis{};         ///< of the joint, a unit vector in the group's frame
  Vector3 point{};        ///< of the axis, in the group's frame
  std::vector<GroupedBody> bodies;
  Real mass = 0;
  Vector3 first_moment{};  ///< kg m, in the group's frame
  Matrix3 inertia{};       ///< about the origin of the group's frame, in its axes
};

/// A robot without fixed joints.
struct GroupedRobot {
  std::vector<MovingGroup> groups;  ///< [0] is the base's; parents before children, depth first
  int tip_group = -1;               ///< -1: no tip was asked for
  Pose tip{};                       ///< of the tip's frame in its group's
  Vector3 base_acceleration{};      ///< -g in the base body's frame, m/s^2
  std::vector<Diagnostic> warnings;
};

/// Joins what fixed joints join; the masses are added.
///
/// With a tip: the chain from the base to the tip, whatever the root; what moves beside it is left
/// out with a warning. Gravity points as the description says if only fixed joints lie between the
/// root and the base, else as if the base stood where the root stands, with a warning.
/// @throws ModelError  by way of `diagnostics` (file name and text of the description) if a name is
///         unknown, a joint of the part cannot be modelled, or nothing moves
GroupedRobot grouped(const BodyTree& tree, const TreePart& part, Diagnostics& diagnostics);

}  // namespace dyngen
