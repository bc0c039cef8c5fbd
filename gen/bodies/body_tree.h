// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gen/bodies/geometry.h"
#include "gen/diagnostic/diagnostic.h"

namespace dyngen {

/// A piece of a description's text, for messages.
struct TextPlace {
  SourcePosition position{};
  int length = 1;  ///< characters, >= 1
};

/// A rigid body and its frame, which hangs on the frame of its joint. kg, m.
struct Body {
  std::string name;
  Real mass = 0;
  Vector3 centre{};   ///< of mass, in the body's frame
  Matrix3 inertia{};  ///< about the centre of mass, in the axes of the body's frame
  bool has_inertial = false;
  TextPlace place{};           ///< of the body
  TextPlace inertial_place{};  ///< of its mass and inertia, or of the body
};

enum class TreeJointType { kRevolute, kPrismatic, kFixed };

/// How a body hangs on another one. At q = 0 the child's frame stands at `pose`; q turns it about
/// (slides it along) the axis.
struct TreeJoint {
  std::string name;
  TreeJointType type = TreeJointType::kFixed;
  int parent = -1;  ///< place in BodyTree::bodies
  int child = -1;
  Pose pose{};                           ///< of the child's frame in the parent's, at q = 0
  Vector3 axis{};                        ///< a unit vector in the child's frame
  Vector3 point{};                       ///< of the axis, in the child's frame
  std::optional<Real> lower, upper;      ///< rad or m
  std::optional<Real> velocity, effort;  ///< largest magnitudes, > 0
  std::optional<Real> damping, friction, armature;  ///< N m s/rad, N m, kg m^2 (N s/m, N, kg)
  Real stiffness = 0;                               ///< of a spring on it, N m/rad (N/m)
  Real spring_reference = 0;                        ///< where the spring rests, rad or m
  /// Why a robot with this joint cannot be modelled; absent: it can.
  std::optional<Diagnostic> refusal;
  TextPlace place{};           ///< of the joint
  TextPlace pose_place{};      ///< of its pose and axis, or of the joint
  TextPlace limit_place{};     ///< of its limits, or of the joint
  TextPlace dynamics_place{};  ///< of its friction, or of the joint
};

/// A robot as URDF and MJCF describe it: bodies, and joints that make a tree of them.
struct BodyTree {
  std::string format;  ///< "URDF", "MJCF"
  std::string name;    ///< as written; empty: none
  std::vector<Body> bodies;
  std::vector<TreeJoint> joints;  ///< one less than bodies; in the order of the text
  Vector3 base_acceleration{};    ///< -g in the root's frame, m/s^2
  TextPlace place{};              ///< of the whole
  TextPlace gravity_place{};      ///< of gravity, or of the whole
  std::vector<Diagnostic> warnings;

  /// The body that no joint carries.
  [[nodiscard]] int root() const;
  /// Place of the body with that name; -1: there is none.
  [[nodiscard]] int body(const std::string& wanted) const;
};

/// How the numbers of a description are read.
struct ReadingOptions {
  /// Angles so near a multiple of pi/12 are that multiple, rad. Angles within kSameAngle always
  /// are.
  Real round_angles = 0;
};

/// Angles that differ less are the same: a right angle of eleven digits is one. rad
inline constexpr Real kSameAngle = 1e-11L;
/// Lengths that differ less are the same. m
inline constexpr Real kSameLength = 1e-12L;

/// Gravity of descriptions that do not speak of it, m/s^2.
inline constexpr Real kStandardGravity = 9.81L;

}  // namespace dyngen
