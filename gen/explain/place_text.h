// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/posture/posture.h"

namespace dyngen {

/// "+x", "-z", or "(0.7071, 0, 0.7071)".
std::string direction_text(const Vec3& direction);
/// "(0.4318, 0.1501, 0)"
std::string point_text(const Vec3& point);
/// "turns about +y through (0.4318, 0.1501, 0)"
std::string axis_place_text(const PosedLink& link);

/// One entry per joint: where its axis points and stands in the base's frame, and where its x
/// points. A wrong sign in a row of the table changes it.
std::string describe_places(const Posture& posture);

}  // namespace dyngen
