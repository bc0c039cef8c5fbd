// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <string>

#include "gen/bodies/body_tree.h"
#include "gen/mjcf/mjcf_defaults.h"

namespace dyngen {

/// How a model's <compiler> says that angles are written.
struct MjcfAngles {
  bool degrees = true;          ///< MuJoCo's default
  std::string euler = "xyz";    ///< axes that turn with the body; in capitals: axes that stand
  Real tolerance = kSameAngle;  ///< rad: so near a multiple of pi/12 an angle is that multiple
};

/// rad
Real mjcf_angle(Real written, const MjcfAngles& angles);

/// Numbers of an attribute that may be missing.
std::optional<Vector3> mjcf_vector(const MjcfAttributes& attributes, std::string_view name,
                                   XmlValues& values);

/// pos and one of quat, axisangle, xyaxes, zaxis, euler. More than one of these is reported.
Pose mjcf_pose(const MjcfAttributes& attributes, const MjcfAngles& angles, XmlValues& values);

/// The turn that takes z to a direction by the shortest way.
Matrix3 turn_z_to(const Vector3& direction);

}  // namespace dyngen
