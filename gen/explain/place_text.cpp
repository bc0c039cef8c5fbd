// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/explain/place_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "gen/explain/text.h"

namespace dyngen {
namespace {

constexpr double kNothing = 1e-9;  // m, and of unit vectors

/// Four digits; rounding alone is 0.
std::string number_text(double value) {
  return std::abs(value) < kNothing ? "0" : fmt::format("{:.4g}", value);
}

bool same_place(const Frame& a, const Frame& b) {
  return norm(a.origin - b.origin) < kNothing && norm(a.x - b.x) < kNothing &&
         norm(a.z - b.z) < kNothing;
}

}  // namespace

std::string point_text(const Vec3& point) {
  return fmt::format("({}, {}, {})", number_text(point.x), number_text(point.y),
                     number_text(point.z));
}

std::string direction_text(const Vec3& direction) {
  constexpr std::array<char, 3> kNames = {'x', 'y', 'z'};
  const std::array<double, 3> components = {direction.x, direction.y, direction.z};
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::abs(std::abs(components[k]) - 1) > kNothing) continue;
    return fmt::format("{}{}", components[k] > 0 ? '+' : '-', kNames[k]);
  }
  return point_text(direction);
}

std::string axis_place_text(const PosedLink& link) {
  const std::string z = direction_text(link.frame.z), origin = point_text(link.frame.origin);
  switch (link.type) {
    case JointType::kRevolute:
      return fmt::format("turns about {} through {}", z, origin);
    case JointType::kPrismatic:
      return fmt::format("slides along {}, now at {}", z, origin);
    case JointType::kFixed:
      break;
  }
  return fmt::format("is fixed at {}, z along {}", origin, z);
}

std::string describe_places(const Posture& posture) {
  const std::string stand_ins = stand_in_text(posture);
  std::string text =
      fill_lines("\nWhere the axes stand, seen from the base (x y z of frame 0, m), ",
                 configuration_text(posture) + (stand_ins.empty() ? "" : ", with " + stand_ins), 2);
  std::size_t width = 0;
  for (const PosedLink& link : posture.links) width = std::max(width, link.name.size());
  for (std::size_t i = 0; i < posture.links.size(); ++i) {
    const PosedLink& link = posture.links[i];
    const std::string line =
        fmt::format("{}; x{} along {}", axis_place_text(link), i + 1, direction_text(link.frame.x));
    text += fill_lines(fmt::format("  {:>2} {:<{}} ", i + 1, link.name, width), line, 6);
    if (same_place(link.frame, link.tip)) continue;
    text += fill_lines("      ",
                       fmt::format("the file's frame {} stands at {}, x along {}, z along {}",
                                   i + 1, point_text(link.tip.origin), direction_text(link.tip.x),
                                   direction_text(link.tip.z)),
                       6);
  }
  return text;
}

}  // namespace dyngen
