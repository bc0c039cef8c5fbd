// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/mjcf/mjcf_joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dyngen {

MjcfJoint MjcfJoints::read(const MjcfItem& item, const std::string& body) {
  const XmlElement& element = *item.element;
  const MjcfAttributes own = defaults_.of(element, "joint", item.given_class, values_);
  MjcfJoint made;
  TreeJoint& joint = made.joint;
  joint.place = joint.pose_place = joint.limit_place = joint.dynamics_place =
      place_in_mjcf(element);
  const XmlAttribute* name = own.find("name");
  const std::size_t number = ++joints_without_name_[body];
  joint.name = name != nullptr ? name->value
               : number == 1   ? body + "_joint"
                               : fmt::format("{}_joint{}", body, number);
  if (!names_.emplace(joint.name, element.position.line).second) {
    values_.error(element, fmt::format("joint '{}' stands twice", printable(joint.name)),
                  "each joint has a name of its own");
  }
  read_type(own, element, joint);
  if (joint.refusal) return made;
  read_axis(own, element, item.around, joint);
  made.reference = norm(joint.axis) == 0 ? 0 : coordinate(own, "ref", joint);
  read_range(own, joint);
  read_dynamics(own, joint);
  return made;
}

void MjcfJoints::read_type(const MjcfAttributes& own, const XmlElement& element, TreeJoint& joint) {
  const XmlAttribute* type = own.find("type");
  const std::string kind = element.name == "freejoint" ? "free"
                           : type == nullptr           ? "hinge"
                                                       : type->value;
  joint.type = kind == "slide" ? TreeJointType::kPrismatic : TreeJointType::kRevolute;
  if (kind == "free" || kind == "ball") {
    joint.refusal = {Severity::kError, element.position, element.length,
                     fmt::format("joint '{}' is a {} joint: such joints are not modelled",
                                 printable(joint.name), kind),
                     "expected hinge or slide; --base BODY chooses a part that stands on a body"};
    joint.axis = {{0, 0, 1}};
    return;
  }
  if (kind != "hinge" && kind != "slide") {
    values_.error(*type,
                  fmt::format("joint '{}' has the type '{}', which is unknown",
                              printable(joint.name), printable(kind)),
                  "expected hinge or slide");
  }
}

void MjcfJoints::read_axis(const MjcfAttributes& own, const XmlElement& element,
                           const RigidPose& around, TreeJoint& joint) {
  const RealVector axis = mjcf_vector(own, "axis", values_).value_or(RealVector{{0, 0, 1}});
  const Real length = norm(axis);
  if (length == 0) {
    values_.error(element,
                  fmt::format("the axis of joint '{}' has no length", printable(joint.name)),
                  "expected a direction: axis=\"0 0 1\"");
    return;
  }
  joint.axis = around.R * ((1 / length) * axis);
  joint.point = around * mjcf_vector(own, "pos", values_).value_or(RealVector{});
}

Real MjcfJoints::coordinate(const MjcfAttributes& own, std::string_view name,
                            const TreeJoint& joint) {
  const XmlAttribute* attribute = own.find(name);
  if (attribute == nullptr) return 0;
  const Real value = values_.number(*attribute).value_or(0);
  return joint.type == TreeJointType::kPrismatic ? value : mjcf_angle(value, settings_.angles);
}

void MjcfJoints::read_range(const MjcfAttributes& own, TreeJoint& joint) {
  if (const XmlAttribute* force = own.find("actuatorfrcrange")) {
    if (const auto v = values_.numbers(*force, 2)) {
      const Real most = std::max(std::fabs((*v)[0]), std::fabs((*v)[1]));
      if (most > 0) joint.effort = most;
    }
  }
  const XmlAttribute* limited = own.find("limited");
  const XmlAttribute* range = own.find("range");
  if (range == nullptr || (limited != nullptr && limited->value == "false")) return;
  if (limited == nullptr && !settings_.limits_by_range) return;
  const auto v = values_.numbers(*range, 2);
  if (!v) return;
  joint.limit_place = {range->position, range->length};
  const bool angle = joint.type == TreeJointType::kRevolute;
  const Real low = angle ? mjcf_angle((*v)[0], settings_.angles) : (*v)[0];
  const Real high = angle ? mjcf_angle((*v)[1], settings_.angles) : (*v)[1];
  if (low > high) {
    values_.error(*range,
                  fmt::format("range of joint '{}' begins above its end", printable(joint.name)),
                  "expected the lower limit first");
    return;
  }
  if (low == high) return;  // MuJoCo's default, 0 0
  joint.lower = low;
  joint.upper = high;
}

std::optional<Real> MjcfJoints::magnitude(const MjcfAttributes& own, std::string_view name,
                                          TreeJoint& joint) {
  const XmlAttribute* attribute = own.find(name);
  if (attribute == nullptr) return std::nullopt;
  joint.dynamics_place = {attribute->position, attribute->length};
  const std::optional<Real> value = values_.number(*attribute);
  if (value && *value < 0) {
    values_.error(*attribute,
                  fmt::format("{} of joint '{}' is negative", name, printable(joint.name)),
                  "expected 0 or more");
  }
  return value;
}

void MjcfJoints::read_dynamics(const MjcfAttributes& own, TreeJoint& joint) {
  joint.damping = magnitude(own, "damping", joint);
  joint.friction = magnitude(own, "frictionloss", joint);
  joint.armature = magnitude(own, "armature", joint);
  joint.stiffness = magnitude(own, "stiffness", joint).value_or(0);
  joint.spring_reference = coordinate(own, "springref", joint);
  if (const XmlAttribute* spring = own.find("springdamper")) {
    const auto v = values_.numbers(*spring, 2);
    if (v && ((*v)[0] != 0 || (*v)[1] != 0)) {
      values_.error(*spring,
                    fmt::format("springdamper of joint '{}' is not read", printable(joint.name)),
                    "write stiffness and damping");
    }
  }
}

}  // namespace dyngen
