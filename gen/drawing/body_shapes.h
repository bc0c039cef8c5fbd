// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/drawing/arm_parts.h"
#include "gen/drawing/paper.h"

namespace dyngen {

/// The cylinder of a revolute joint about its z, the box of a prismatic one along its z, the flat
/// plate of a fixed one; as SVG.
std::string body_shape(const ArmParts& parts, const ArmParts::Body& body, const PosedLink& link,
                       const Paper& paper);

/// A hatched square where the base is fixed.
std::string ground_shape(const ArmParts& parts, const Paper& paper);

}  // namespace dyngen
