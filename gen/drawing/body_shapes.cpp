// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/drawing/body_shapes.h"

#include <array>
#include <cmath>
#include <vector>

#include "gen/drawing/svg.h"

namespace dyngen {
namespace {

constexpr const char* kFill = "#f6dfa4";
constexpr const char* kShade = "#e3c06a";
constexpr const char* kDark = "#c9a24a";
constexpr const char* kEdge = "#5c4300";
constexpr const char* kPlate = "#d5dae0";

std::string cylinder(const Vec3& centre, const Vec3& axis, double half, double radius,
                     const Paper& paper) {
  const bool forward = paper.view.depth(axis) >= 0;
  const Vec3 ahead = forward ? axis : -axis;
  const Point front = paper.at(centre + half * ahead), back = paper.at(centre - half * ahead);
  const double rho = radius * paper.scale;
  const Point way = front - back;
  if (length(way) < 0.5) return svg::ellipse(front, rho, rho, 0, kFill, kEdge);
  const Point side = (rho / length(way)) * Point{-way.y, way.x};
  const double flat = rho * std::abs(paper.view.depth(axis));
  const double turn = std::atan2(side.y, side.x);
  return svg::ellipse(back, rho, flat, turn, kShade, kEdge) +
         svg::polygon({back + side, front + side, front - side, back - side}, kShade, "none") +
         svg::line(back + side, front + side, kEdge, 1) +
         svg::line(back - side, front - side, kEdge, 1) +
         svg::ellipse(front, rho, flat, turn, kFill, kEdge);
}

/// @param a  half of the edges along x, y, z of the frame
std::string box(const Vec3& centre, const Frame& frame, const std::array<double, 3>& a, bool moving,
                const Paper& paper) {
  const std::array<Vec3, 3> axes = {frame.x, frame.y, frame.z};
  std::string text;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool forward = paper.view.depth(axes[k]) >= 0;
    const Vec3 out = (forward ? a[k] : -a[k]) * axes[k];
    const Vec3 u = a[(k + 1) % 3] * axes[(k + 1) % 3], v = a[(k + 2) % 3] * axes[(k + 2) % 3];
    const Vec3 middle = centre + out;
    const char* fill = k == 2 ? kFill : k == 1 ? kShade : kDark;
    text += svg::polygon({paper.at(middle + u + v), paper.at(middle + u - v),
                          paper.at(middle - u - v), paper.at(middle - u + v)},
                         moving ? fill : kPlate, kEdge);
  }
  return text;
}

}  // namespace

std::string body_shape(const ArmParts& parts, const ArmParts::Body& body, const PosedLink& link,
                       const Paper& paper) {
  const double half = 0.5 * parts.body_length(), radius = parts.body_radius();
  switch (link.type) {
    case JointType::kRevolute:
      return cylinder(body.centre, link.frame.z, half, radius, paper);
    case JointType::kPrismatic:
      return box(body.centre, link.frame, {0.8 * radius, 0.8 * radius, 1.2 * half}, true, paper);
    case JointType::kFixed:
      break;
  }
  return box(body.centre, link.frame, {radius, radius, 0.3 * radius}, false, paper);
}

std::string ground_shape(const ArmParts& parts, const Paper& paper) {
  const Vec3 n = parts.ground.normal;
  const Vec3 x = {1, 0, 0}, y = {0, 1, 0};
  const Vec3 u = unit(cross(n, std::abs(dot(n, x)) < 0.9 ? x : y)), v = cross(n, u);
  const double half = 0.1 * parts.size;
  const auto corner = [&](double a, double b) {
    return paper.at(parts.ground.centre + (a * half) * u + (b * half) * v);
  };
  std::string text = svg::polygon({corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)},
                                  "#eceff2", "#57606a");
  for (const double at : {-1.0, -0.5, 0.0, 0.5}) {  // hatching
    text += svg::line(corner(at, -1), corner(at + 0.5, 1), "#8c959f", 0.8);
  }
  return text;
}

}  // namespace dyngen
