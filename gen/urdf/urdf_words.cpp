// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/urdf/urdf_words.h"

#include <map>
#include <vector>

#include "gen/xml/known_attributes.h"

namespace dyngen {
namespace {

using Words = std::vector<std::string_view>;

/// Source: wiki.ros.org/urdf/XML and the schema of ros/urdfdom.
const std::map<std::string_view, Words> kUrdfAttributes = {
    {"link", {"name", "type"}},
    {"joint", {"name", "type"}},
    {"origin", {"xyz", "rpy"}},
    {"mass", {"value"}},
    {"inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}},
    {"inertial", {}},
    {"parent", {"link"}},
    {"child", {"link"}},
    {"axis", {"xyz"}},
    {"limit", {"lower", "upper", "effort", "velocity", "acceleration", "jerk", "deceleration"}},
    {"mimic", {"joint", "multiplier", "offset"}},
};

void check_urdf_element(const XmlElement& element, XmlValues& values) {
  const auto known = kUrdfAttributes.find(element.name);
  if (known == kUrdfAttributes.end()) return;
  warn_of_unknown_attributes(element, known->second, "URDF", values);
  for (const XmlElement& child : element.children) check_urdf_element(child, values);
}

}  // namespace

void check_urdf_attributes(const XmlElement& robot, XmlValues& values) {
  for (const XmlElement& child : robot.children) check_urdf_element(child, values);
}

}  // namespace dyngen
