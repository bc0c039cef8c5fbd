// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/drawing/arm_parts.h"

namespace dyngen {

/// A place on the paper, y upwards.
struct Point {
  double x = 0, y = 0;
};

inline Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
inline Point operator*(double factor, const Point& a) { return {factor * a.x, factor * a.y}; }
inline double length(const Point& a) { return std::hypot(a.x, a.y); }

/// A parallel projection: where somebody looks from.
struct Viewpoint {
  Vec3 right = {1, 0, 0}, up = {0, 1, 0}, towards = {0, 0, 1};  ///< unit vectors of frame 0

  [[nodiscard]] Point project(const Vec3& place) const {
    return {dot(place, right), dot(place, up)};
  }
  /// How far towards the eye.
  [[nodiscard]] double depth(const Vec3& place) const { return dot(place, towards); }
};

/// From somewhat above, of some directions around the arm the one in which origins of frames, axes
/// and bodies hide each other least.
/// @param up  unit vector that points upwards on the paper
Viewpoint choose_view(const ArmParts& parts, const Vec3& up);

}  // namespace dyngen
