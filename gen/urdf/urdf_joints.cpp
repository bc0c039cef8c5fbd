// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/urdf/urdf_joints.h"

#include <fmt/format.h>

#include <array>

#include "gen/bodies/decimal.h"

namespace dyngen {
namespace {

constexpr std::array<std::string_view, 9> kKnownInJoint = {
    "origin",     "parent", "child", "axis", "limit", "mimic", "dynamics", "safety_controller",
    "calibration"};

}  // namespace

std::optional<TreeJoint> UrdfJoints::read(const XmlElement& element) {
  const XmlAttribute* name = values_.required(element, "name", "a joint");
  if (name == nullptr) return std::nullopt;
  TreeJoint joint;
  joint.name = name->value;
  const std::string whose = fmt::format("joint '{}'", printable(joint.name));
  joint.place = joint.pose_place = joint.limit_place = joint.dynamics_place =
      place_in_urdf(element);
  const auto [first, is_first] = names_.emplace(joint.name, element.position.line);
  if (!is_first) {
    values_.error(*name, whose + " stands twice",
                  fmt::format("the first is on line {}", first->second));
  }
  const bool continuous = read_type(element, whose, joint);
  if (const XmlElement* mimic = elements_.only_child(element, "mimic")) {
    const XmlAttribute* other = mimic->attribute("joint");
    joint.refusal = {Severity::kError, mimic->position, mimic->length,
                     fmt::format("{} mimics joint '{}': joints that are coupled are not modelled",
                                 whose, other == nullptr ? "?" : printable(other->value)),
                     "make it fixed, or choose a part without it by --base LINK --tip LINK"};
  }
  joint.parent = read_end(element, "parent", whose);
  joint.child = read_end(element, "child", whose);
  joint.pose = elements_.origin(element, whose);
  if (const XmlElement* own = element.child("origin")) joint.pose_place = place_in_urdf(*own);
  if (joint.type == TreeJointType::kFixed) joint.refusal.reset();
  if (joint.type != TreeJointType::kFixed && !joint.refusal) {
    read_axis(element, whose, joint);
    read_limits(element, whose, continuous, joint);
    read_dynamics(element, joint);
  }
  for (const XmlElement& child : element.children) {
    if (!stands_among(child.name, kKnownInJoint)) elements_.warn_of_unknown(child, whose);
  }
  return joint;
}

bool UrdfJoints::read_type(const XmlElement& element, const std::string& whose, TreeJoint& joint) {
  const XmlAttribute* type = values_.required(element, "type", whose);
  if (type == nullptr) return false;
  if (type->value == "revolute" || type->value == "continuous") {
    joint.type = TreeJointType::kRevolute;
  } else if (type->value == "prismatic") {
    joint.type = TreeJointType::kPrismatic;
  } else if (type->value == "fixed") {
    joint.type = TreeJointType::kFixed;
  } else if (type->value == "floating" || type->value == "planar") {
    joint.type = TreeJointType::kRevolute;  // it moves
    joint.refusal = {Severity::kError, type->position, type->length,
                     fmt::format("{} is {}: such joints are not modelled", whose, type->value),
                     "expected revolute, continuous, prismatic or fixed; --base LINK chooses a "
                     "part that stands on a fixed link"};
  } else {
    values_.error(
        *type, fmt::format("{} has the type '{}', which is unknown", whose, printable(type->value)),
        "expected revolute, continuous, prismatic or fixed");
  }
  return type->value == "continuous";
}

int UrdfJoints::read_end(const XmlElement& element, std::string_view end,
                         const std::string& whose) {
  const XmlElement* child = elements_.only_child(element, end);
  if (child == nullptr) {
    values_.error(element, fmt::format("{} has no <{}>", whose, end),
                  fmt::format("expected <{} link=\"...\"/>", end));
    return -1;
  }
  const XmlAttribute* link =
      values_.required(*child, "link", fmt::format("<{}> of {}", end, whose));
  if (link == nullptr) return -1;
  const auto found = links_.find(link->value);
  if (found != links_.end()) return static_cast<int>(found->second);
  values_.error(*link,
                fmt::format("the {} of {} is link '{}', which does not exist", end, whose,
                            printable(link->value)),
                "expected the name of a <link>");
  return -1;
}

void UrdfJoints::read_axis(const XmlElement& element, const std::string& whose, TreeJoint& joint) {
  const XmlElement* child = elements_.only_child(element, "axis");
  joint.axis = {{1, 0, 0}};
  if (child == nullptr) return;
  const XmlAttribute* xyz = values_.required(*child, "xyz", "the axis of " + whose);
  if (xyz == nullptr) return;
  const RealVector axis = elements_.vector(*child, "xyz", joint.axis);
  const Real length = norm(axis);
  if (length == 0) {
    values_.error(*xyz, fmt::format("the axis of {} has no length", whose),
                  "expected a direction: <axis xyz=\"0 0 1\"/>");
    return;
  }
  joint.axis = (1 / length) * axis;
}

void UrdfJoints::read_limits(const XmlElement& element, const std::string& whose, bool continuous,
                             TreeJoint& joint) {
  const XmlElement* limit = elements_.only_child(element, "limit");
  if (limit == nullptr) return;
  joint.limit_place = place_in_urdf(*limit);
  const auto magnitude = [&](std::string_view name) -> std::optional<Real> {
    const std::optional<Real> value = values_.number(*limit, name);
    if (!value || *value > 0) return value;
    if (*value < 0) {
      values_.warning(*limit->attribute(name),
                      fmt::format("{} of {} is negative, and taken as no limit", name, whose),
                      "expected a magnitude");
    }
    return std::nullopt;  // 0 is what exporters write for "not known"
  };
  joint.velocity = magnitude("velocity");
  joint.effort = magnitude("effort");
  if (continuous) return;
  const std::optional<Real> lower = values_.number(*limit, "lower");
  const std::optional<Real> upper = values_.number(*limit, "upper");
  if (!lower && !upper) return;
  const Real low = lower.value_or(0), high = upper.value_or(0);
  if (low > high) {
    values_.error(
        *limit,
        fmt::format("lower of {} is {}, above its upper {}", whose, decimal(low), decimal(high)),
        "expected lower below upper");
    return;
  }
  if (low == high) {  // what exporters write for "not known"
    values_.warning(*limit, fmt::format("lower and upper of {} are both {}", whose, decimal(low)),
                    "taken as a joint without limits");
    return;
  }
  joint.lower = low;
  joint.upper = high;
}

void UrdfJoints::read_dynamics(const XmlElement& element, TreeJoint& joint) {
  const XmlElement* dynamics = elements_.only_child(element, "dynamics");
  if (dynamics == nullptr) return;
  joint.dynamics_place = place_in_urdf(*dynamics);
  joint.damping = values_.number(*dynamics, "damping");
  joint.friction = values_.number(*dynamics, "friction");
  for (const XmlAttribute& attribute : dynamics->attributes) {
    if (attribute.name == "damping" || attribute.name == "friction") continue;
    values_.warning(attribute,
                    fmt::format("'{}' of joint '{}' is left out", printable(attribute.name),
                                printable(joint.name)),
                    "URDF's <dynamics> has damping and friction");
  }
}

}  // namespace dyngen
