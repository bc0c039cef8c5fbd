// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/bodies/body_tree.h"
#include "gen/xml/xml_document.h"

namespace dyngen {

/// Reads URDF: links, joints, inertials, limits, damping and friction; SI units. Gravity is along
/// -z of the root link.
///
/// Revolute and continuous joints turn, prismatic ones slide. What carries no dynamics is passed
/// over: visual, collision, material, sensor, safety_controller, calibration, transmission, gazebo.
/// Joints that mimic others, float or are planar carry their refusal (TreeJoint::refusal): the part
/// that is chosen may do without them.
/// @throws ModelError  positioned: xacro that is not expanded; joints of unknown type; links
///         missing, twice, in a loop or without a common root; numbers that are none; an axis of no
///         length
BodyTree read_urdf(const XmlDocument& document, const ReadingOptions& options = {});

}  // namespace dyngen
