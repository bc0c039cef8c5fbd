// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/mjcf/geom_inertia.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace dyngen {

namespace {

/// MuJoCo's density of geoms that have none, kg/m^3: of water.
constexpr Real kDefaultDensity = 1000;

/// Shape of a solid by half lengths: volume, and moments of inertia per mass about its axes.
struct Solid {
  Real volume = 0;
  RealVector moments{};
};

Solid solid_of(const std::string& type, const std::vector<Real>& size) {
  if (type == "sphere") {
    const Real r = size[0], moment = 2 * r * r / 5;
    return {4 * kRealPi * r * r * r / 3, {{moment, moment, moment}}};
  }
  if (type == "cylinder") {
    const Real r = size[0], h = 2 * size[1];
    const Real side = (3 * r * r + h * h) / 12;
    return {kRealPi * r * r * h, {{side, side, r * r / 2}}};
  }
  if (type == "capsule") {  // a cylinder between two half spheres
    const Real r = size[0], h = 2 * size[1];
    const Real tube = kRealPi * r * r * h, ball = 4 * kRealPi * r * r * r / 3;
    const Real of_ball = ball / (tube + ball), of_tube = 1 - of_ball;
    const Real side =
        of_tube * (3 * r * r + h * h) / 12 + of_ball * (2 * r * r / 5 + h * (3 * r + 2 * h) / 8);
    return {tube + ball, {{side, side, of_tube * r * r / 2 + of_ball * 2 * r * r / 5}}};
  }
  const Real a = size[0] * size[0], b = size[1] * size[1], c = size[2] * size[2];
  const bool box = type == "box";
  const Real part = box ? 3 : 5;
  return {(box ? Real(8) : 4 * kRealPi / 3) * size[0] * size[1] * size[2],
          {{(b + c) / part, (a + c) / part, (a + b) / part}}};
}

std::size_t sizes_of(const std::string& type) {
  if (type == "sphere") return 1;
  return type == "capsule" || type == "cylinder" ? 2 : 3;
}

class GeomReader {
 public:
  GeomReader(const XmlElement& geom, const MjcfAttributes& attributes, const MjcfAngles& angles,
             XmlValues& values)
      : geom_(geom), attributes_(attributes), angles_(angles), values_(values) {}

  std::optional<GeomInertia> read(const RigidPose& around) {
    const XmlAttribute* type = attributes_.find("type");
    const std::string name = type == nullptr ? "sphere" : type->value;
    const std::optional<Real> mass = number("mass");
    if (mass && *mass == 0) return GeomInertia{};
    if (name == "plane" || name == "hfield") return GeomInertia{};
    if (const XmlAttribute* shell = attributes_.find("shellinertia")) {
      if (shell->value == "true") return refuse("a shell (shellinertia)");
    }
    if (attributes_.find("mesh") != nullptr || name == "mesh") return refuse("a mesh");
    constexpr std::array<std::string_view, 5> kSolids = {"sphere", "capsule", "cylinder",
                                                         "ellipsoid", "box"};
    if (std::find(kSolids.begin(), kSolids.end(), name) == kSolids.end()) {
      return refuse("of type '" + printable(name) + "'");
    }
    RigidPose pose = mjcf_pose(attributes_, angles_, values_);
    const std::optional<std::vector<Real>> size = size_of(name, pose);
    if (!size) return std::nullopt;
    const Solid solid = solid_of(name, *size);
    GeomInertia result;
    result.mass = mass.value_or(number("density").value_or(kDefaultDensity) * solid.volume);
    pose = around * pose;
    result.centre = pose.p;
    RealMatrix own;
    for (std::size_t k = 0; k < 3; ++k) own[k][k] = result.mass * solid.moments[k];
    result.inertia = turned(pose.R, own);
    return result;
  }

 private:
  std::optional<GeomInertia> refuse(const std::string& what) {
    values_.error(geom_, fmt::format("the body has no <inertial>, and its geom is {}", what),
                  "give the body an <inertial>, or the geom mass=\"0\"");
    return std::nullopt;
  }

  std::optional<Real> number(std::string_view name) {
    const XmlAttribute* attribute = attributes_.find(name);
    if (attribute == nullptr) return std::nullopt;
    const std::optional<Real> value = values_.number(*attribute);
    if (value && *value < 0) {
      values_.error(*attribute, fmt::format("the {} of the geom is negative", name),
                    "expected 0 or more");
    }
    return value;
  }

  /// Half lengths; the pose is that of `fromto` where it is given.
  std::optional<std::vector<Real>> size_of(const std::string& type, RigidPose& pose) {
    const XmlAttribute* fromto = attributes_.find("fromto");
    const XmlAttribute* size = attributes_.find("size");
    const std::size_t wanted = fromto != nullptr ? 1 : sizes_of(type);
    if (size == nullptr) {
      values_.error(geom_, "the geom has no size", fmt::format("expected {} numbers", wanted));
      return std::nullopt;
    }
    std::optional<std::vector<Real>> result = values_.numbers(*size, wanted, 3);
    if (!result) return std::nullopt;
    if (fromto != nullptr && !follow(*fromto, type, *result, pose)) return std::nullopt;
    for (std::size_t k = 0; k < sizes_of(type); ++k) {
      if ((*result)[k] > 0) continue;
      values_.error(*size, "a size is 0 or negative", "expected half lengths, in m");
      return std::nullopt;
    }
    return result;
  }

  bool follow(const XmlAttribute& fromto, const std::string& type, std::vector<Real>& size,
              RigidPose& pose) {
    if (type == "sphere") {
      values_.error(fromto, "a sphere has no 'fromto'", "expected a capsule, cylinder or box");
      return false;
    }
    const auto ends = values_.numbers(fromto, 6);
    if (!ends) return false;
    const RealVector from{{(*ends)[0], (*ends)[1], (*ends)[2]}},
        to{{(*ends)[3], (*ends)[4], (*ends)[5]}};
    const Real length = norm(from - to);
    if (length == 0) {
      values_.error(fromto, "both ends of 'fromto' are the same", "expected two points");
      return false;
    }
    pose = {turn_z_to((1 / length) * (from - to)), Real(0.5) * (from + to)};
    const Real radius = size[0];
    size = sizes_of(type) == 2 ? std::vector<Real>{radius, length / 2}
                               : std::vector<Real>{radius, radius, length / 2};
    return true;
  }

  const XmlElement& geom_;
  const MjcfAttributes& attributes_;
  const MjcfAngles& angles_;
  XmlValues& values_;
};

}  // namespace

std::optional<GeomInertia> geom_inertia(const XmlElement& geom, const MjcfAttributes& attributes,
                                        const RigidPose& pose, const MjcfAngles& angles,
                                        XmlValues& values) {
  return GeomReader(geom, attributes, angles, values).read(pose);
}

}  // namespace dyngen
