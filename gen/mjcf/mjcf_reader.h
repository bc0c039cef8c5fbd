// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/bodies/body_tree.h"
#include "gen/xml/xml_document.h"

namespace dyngen {

/// Reads a subset of MJCF: bodies and frames, hinge and slide joints, inertials or the inertia of
/// simple geoms, default classes, armature, damping, frictionloss, springs, gravity; MuJoCo's
/// defaults and units. The world is the root body "world"; a body with several joints hangs on
/// bodies without mass.
///
/// Free and ball joints, and joints that an equality or a tendon couples, carry their refusal
/// (TreeJoint::refusal). Warned of: actuators' gears, gravity compensation, fluids.
/// @throws ModelError  positioned: include, replicate, attach, composite, flexcomp, plugin; global
///         coordinates; meshes without an inertial; numbers that are none; names that stand twice
BodyTree read_mjcf(const XmlDocument& document, const ReadingOptions& options = {});

}  // namespace dyngen
