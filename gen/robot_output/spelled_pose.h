// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <string>

#include "gen/bodies/geometry.h"

namespace dyngen {

/// Angles of fixed axes, so that turn_rpy() of them is the turn. rad
Vector3 rpy_of(const Matrix3& turn);

/// Unit quaternion w x y z, w >= 0.
std::array<Real, 4> quaternion_of(const Matrix3& turn);

/// "x y z", each number so that it reads back as the nearest double; what rounding has left of zero
/// beside the largest is 0.
std::string spelled_vector(const Vector3& v);

}  // namespace dyngen
