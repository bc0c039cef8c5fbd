// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gen/robot_input/robot_input.h"

namespace dyngen {

/// Other numbers of a body: all three at once.
struct BodyEdit {
  int body = -1;         ///< place in BodyTree::bodies
  Real mass = 0;         ///< kg, > 0
  RealVector centre{};   ///< of mass, in the body's frame, m
  RealMatrix inertia{};  ///< about the centre of mass, in the axes of the body's frame, kg m^2
};

/// Other numbers of a joint; absent ones stay.
struct JointEdit {
  int joint = -1;                                   ///< place in BodyTree::joints
  std::optional<Real> damping, friction;            ///< N m s/rad, N m (N s/m, N)
  std::optional<Real> armature;                     ///< kg m^2 (kg); MJCF alone
  std::optional<Real> stiffness, spring_reference;  ///< N m/rad, rad (N/m, m); MJCF alone
};

/// What becomes of the actuators of a joint, MJCF alone.
struct DriveEdit {
  int joint = -1;
  Real gain = 1;           ///< its torque is so many times what it was
  Real time_constant = 0;  ///< s, of a first-order lag in front of it; 0: none
};

struct DescriptionEdit {
  std::vector<BodyEdit> bodies;
  std::vector<JointEdit> joints;
  std::vector<DriveEdit> drives;
  std::vector<std::string> comment;  ///< lines that stand at the beginning of the root
};

struct EditedDescription {
  std::string text;
  /// (drives) empty: it was written; else why it was not, a phrase.
  std::vector<std::string> drives_left_out;
};

/// The description with other numbers; every other byte is the same. Numbers read back as the same
/// doubles.
/// @throws ModelError  positioned, where a MJCF's compiler would pass over the numbers
///         (inertiafromgeom="true", settotalmass, boundmass, boundinertia, balanceinertia)
EditedDescription edited(const DescribedBodies& bodies, const DescriptionEdit& edit);

}  // namespace dyngen
