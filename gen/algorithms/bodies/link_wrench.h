// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/algorithms/bodies/link_inertia.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/algorithms/kinematics/kinematics.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Force that moves a link: M VP + U MS.
Vector3 link_force(const LinkInertia& inertia, const LinkMotion& motion);

/// Moment about its origin that moves a link: J WP + W x (J W) + MS x VP, written with U.
/// @param mark  begins the names of what is assigned
Vector3 link_moment(Trace& trace, const std::string& mark, int link, const LinkInertia& inertia,
                    const LinkMotion& motion);

}  // namespace dyngen
