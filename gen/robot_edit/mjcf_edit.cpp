// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "gen/bodies/decimal.h"
#include "gen/robot_edit/edit_formats.h"
#include "gen/xml/xml_values.h"

namespace dyngen {

namespace {

/// Settings of <compiler> by which MuJoCo changes bodies' numbers after it has read them, and the
/// values with which it does not.
struct OverridingSetting {
  std::string_view name;
  std::array<std::string_view, 2> harmless;
};
constexpr std::array<OverridingSetting, 5> kOverridingSettings = {
    {{"inertiafromgeom", {"false", "auto"}},
     {"balanceinertia", {"false", "false"}},
     {"settotalmass", {"-1", "-1.0"}},
     {"boundmass", {"0", "0.0"}},
     {"boundinertia", {"0", "0.0"}}}};

/// Whether the model writes angles in degrees, as MuJoCo does where nothing says otherwise.
bool angles_in_degrees(const DescribedBodies& bodies) {
  bool degrees = true;
  for (const XmlElement& section : bodies.document.root.children) {
    const XmlAttribute* angle = section.name == "compiler" ? section.attribute("angle") : nullptr;
    if (angle != nullptr) degrees = angle->value != "radian";
  }
  return degrees;
}

bool stands_in_default(const XmlElement& element, std::string_view attribute, bool within = false) {
  const bool here = within || element.name == "default";
  const bool is_actuator = element.name == "general" || element.name == "motor";
  if (here && is_actuator && element.attribute(attribute) != nullptr) return true;
  return std::any_of(
      element.children.begin(), element.children.end(),
      [&](const XmlElement& child) { return stands_in_default(child, attribute, here); });
}

/// Actuators that drive a joint.
std::vector<const XmlElement*> actuators_of(const XmlElement& root, const std::string& joint) {
  std::vector<const XmlElement*> found;
  for (const XmlElement& section : root.children) {
    if (section.name != "actuator") continue;
    for (const XmlElement& actuator : section.children) {
      const XmlAttribute* driven = actuator.attribute("joint");
      if (driven != nullptr && driven->value == joint) found.push_back(&actuator);
    }
  }
  return found;
}

/// "1 0 0 0 0 0", the first times the gain; empty: it is not six numbers at most.
std::string gear_times(const DescribedBodies& bodies, const XmlAttribute* gear, Real gain) {
  if (gear == nullptr) return exact_decimal(gain);
  Diagnostics diagnostics(bodies.document.file_name, bodies.document.text);
  auto values = XmlValues(bodies.document, diagnostics).numbers(*gear, 1, 6);
  if (!values) return {};
  values->front() *= gain;
  return spelled_numbers(*values);
}

}  // namespace

void refuse_overriding_compiler(const DescribedBodies& bodies) {
  Diagnostics diagnostics(bodies.document.file_name, bodies.document.text);
  for (const XmlElement& section : bodies.document.root.children) {
    if (section.name != "compiler") continue;
    for (const OverridingSetting& setting : kOverridingSettings) {
      const XmlAttribute* attribute = section.attribute(setting.name);
      if (attribute == nullptr) continue;
      const bool harmless = std::find(setting.harmless.begin(), setting.harmless.end(),
                                      attribute->value) != setting.harmless.end();
      if (harmless) continue;
      diagnostics.error(attribute->position, attribute->length,
                        fmt::format("{}=\"{}\" changes masses and inertias after they are read",
                                    setting.name, attribute->value),
                        "identified numbers would not stay: take it out of the file");
    }
  }
  if (diagnostics.has_errors()) throw ModelError(diagnostics.render());
}

void edit_mjcf_body(TextPatches& patches, const DescribedBodies& bodies, const BodyEdit& edit) {
  const TreeBody& body = bodies.robot.tree.bodies[static_cast<std::size_t>(edit.body)];
  const XmlElement& element = element_of(bodies, body.place);
  const RealMatrix& I = edit.inertia;
  const std::string text = fmt::format(
      "<inertial pos=\"{}\" mass=\"{}\" fullinertia=\"{}\"/>",
      spelled_numbers({edit.centre[0], edit.centre[1], edit.centre[2]}), exact_decimal(edit.mass),
      spelled_numbers({I[0][0], I[1][1], I[2][2], I[0][1], I[0][2], I[1][2]}));
  if (const XmlElement* inertial = element.child("inertial")) {
    patches.replace(inertial->whole, text);
  } else {
    insert_child(patches, bodies.document, element, text);
  }
}

void edit_mjcf_joint(TextPatches& patches, const DescribedBodies& bodies, const JointEdit& edit) {
  const TreeJoint& joint = bodies.robot.tree.joints[static_cast<std::size_t>(edit.joint)];
  const XmlElement& element = element_of(bodies, joint.place);
  const auto set = [&](std::string_view name, const std::optional<Real>& value) {
    if (value) set_attribute(patches, element, name, exact_decimal(*value));
  };
  set("damping", edit.damping);
  set("frictionloss", edit.friction);
  set("armature", edit.armature);
  set("stiffness", edit.stiffness);
  std::optional<Real> reference = edit.spring_reference;
  if (reference && joint.type == TreeJointType::kRevolute && angles_in_degrees(bodies)) {
    *reference *= 180 / kRealPi;
  }
  set("springref", reference);
}

std::string edit_mjcf_drive(TextPatches& patches, const DescribedBodies& bodies,
                            const DriveEdit& edit) {
  const TreeJoint& joint = bodies.robot.tree.joints[static_cast<std::size_t>(edit.joint)];
  const XmlElement& root = bodies.document.root;
  const auto actuators = actuators_of(root, joint.name);
  if (actuators.empty()) return "the model has no actuator of this joint";
  for (const XmlElement* actuator : actuators) {
    if (actuator->name != "motor" && actuator->name != "general") {
      return fmt::format("its actuator is <{}>, whose gains are a controller's", actuator->name);
    }
    if (actuator->self_closing == false) return "its actuator holds other elements";
    if (actuator->attribute("gear") == nullptr && stands_in_default(root, "gear")) {
      return "the actuator's gear stands in a default class";
    }
    const bool has_dynamics =
        actuator->attribute("dyntype") != nullptr || stands_in_default(root, "dyntype");
    if (edit.time_constant > 0 && has_dynamics) return "its actuator has dynamics already";
  }
  for (const XmlElement* actuator : actuators) {
    if (edit.gain != 1) {
      const std::string gear = gear_times(bodies, actuator->attribute("gear"), edit.gain);
      if (gear.empty()) return "the actuator's gear is not read";
      set_attribute(patches, *actuator, "gear", gear);
    }
    if (!(edit.time_constant > 0)) continue;
    if (actuator->name == "motor") {  // which is <general> without dynamics
      const std::size_t begin = actuator->start_tag.begin + 1;
      patches.replace({begin, begin + actuator->name.size()}, "general");
    }
    const std::size_t end = actuator->start_tag.end - 2;  // of "/>"
    patches.insert(
        end, fmt::format(" dyntype=\"filter\" dynprm=\"{}\"", exact_decimal(edit.time_constant)));
  }
  return {};
}

}  // namespace dyngen
