// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/drawing/view.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dyngen {
namespace {

constexpr double kDegree = 0.017453292519943295;

/// Horizontal: x0 if it is not upright, else y0.
Vec3 front(const Vec3& up) {
  const Vec3 x = {1, 0, 0}, y = {0, 1, 0};
  const Vec3& axis = std::abs(dot(x, up)) < 0.9 ? x : y;
  return unit(axis - dot(axis, up) * up);
}

/// @param azimuth  from `front` counter-clockwise, seen from above, rad  @param elevation  rad
Viewpoint view_from(const Vec3& up, double azimuth, double elevation) {
  const Vec3 ahead = front(up), left = cross(up, ahead);
  const Vec3 level = std::cos(azimuth) * ahead + std::sin(azimuth) * left;
  Viewpoint view;
  view.towards = std::cos(elevation) * level + std::sin(elevation) * up;
  view.right = cross(up, level);
  view.up = cross(view.towards, view.right);
  return view;
}

std::vector<Vec3> distinct_places(const ArmParts& parts) {
  std::vector<Vec3> places;
  const auto add = [&](const Vec3& place) {
    const bool known = std::any_of(places.begin(), places.end(), [&](const Vec3& other) {
      return norm(other - place) < 1e-6 * parts.size;
    });
    if (!known) places.push_back(place);
  };
  for (const ArmParts::Arrow& arrow : parts.arrows) add(arrow.from);
  for (const ArmParts::Body& body : parts.bodies) add(body.centre);
  for (const Vec3& tool : parts.tools) add(tool);
  return places;
}

/// How much is hidden; small is good.
double confusion(const Viewpoint& view, const ArmParts& parts, const std::vector<Vec3>& places) {
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double apart = length(view.project(places[i] - places[k])) / parts.size;
      sum += std::max(0.0, 0.14 - apart) / 0.14;
    }
  }
  for (const ArmParts::Arrow& arrow : parts.arrows) {
    const double share = arrow.axis == 'y' ? 0.3 : 1;
    const Point direction = view.project(arrow.direction);
    sum += share * std::max(0.0, 0.45 - length(direction));
    const Point tip = view.project(arrow.from + parts.arrow_length(arrow.axis) * arrow.direction);
    for (const ArmParts::Arrow& other : parts.arrows) {
      if (&other == &arrow || norm(other.direction - arrow.direction) < 1e-6) continue;
      const Point end = view.project(other.from + parts.arrow_length(other.axis) * other.direction);
      const double apart = length(tip - end) / parts.size;
      sum += 0.5 * share * std::max(0.0, 0.05 - apart) / 0.05;
    }
  }
  return sum;
}

}  // namespace

Viewpoint choose_view(const ArmParts& parts, const Vec3& up) {
  const std::vector<Vec3> places = distinct_places(parts);
  Viewpoint best;
  double least = HUGE_VAL;
  for (const double azimuth : {-60.0, -50.0, -70.0, -40.0, -30.0, -120.0, -130.0, -110.0, 30.0,
                               40.0, 60.0, 50.0, 120.0, 150.0, -150.0}) {
    for (const double elevation : {24.0, 32.0, 17.0}) {
      const Viewpoint view = view_from(up, azimuth * kDegree, elevation * kDegree);
      // rather from the right in front, as most drawings do
      const double habit = azimuth < 0 && azimuth > -90 ? 0 : 0.4;
      const double found = confusion(view, parts, places) + habit;
      if (found < least - 1e-6) {  // not by rounding
        least = found;
        best = view;
      }
    }
  }
  return best;
}

}  // namespace dyngen
