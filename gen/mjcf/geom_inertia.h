// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>

#include "gen/mjcf/mjcf_pose.h"

namespace dyngen {

/// A solid's mass and inertia in a body's frame. kg, m.
struct GeomInertia {
  Real mass = 0;
  Vector3 centre{};
  Matrix3 inertia{};  ///< about its centre, in the body's axes
};

/// Mass and inertia of a geom of one density, as MuJoCo has them: sphere, capsule, cylinder,
/// ellipsoid, box; half lengths in `size`, or `fromto`. Planes and height fields have none.
///
/// @param pose  of the frame that the geom stands in, in the body's
/// @return  none, and reported, for meshes, signed distance fields and shells
std::optional<GeomInertia> geom_inertia(const XmlElement& geom, const MjcfAttributes& attributes,
                                        const Pose& pose, const MjcfAngles& angles,
                                        XmlValues& values);

}  // namespace dyngen
