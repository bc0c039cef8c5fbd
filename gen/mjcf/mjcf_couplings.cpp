// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/mjcf/mjcf_couplings.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace dyngen {
namespace {

class CouplingReader {
 public:
  CouplingReader(const MjcfDefaults& defaults, XmlValues& values, BodyTree& tree)
      : defaults_(defaults), values_(values), tree_(tree) {}

  void read(const XmlElement& root) {
    for (const XmlElement& child : root.children) {
      if (child.name == "equality") read_equalities(child);
      if (child.name == "tendon") read_tendons(child);
      if (child.name == "actuator") read_actuators(child);
    }
  }

 private:
  void refuse_joint(const std::string& name, const XmlElement& by, const std::string& what) {
    for (TreeJoint& joint : tree_.joints) {
      if (joint.name != name || joint.refusal) continue;
      joint.refusal = {Severity::kError, by.position, by.length,
                       fmt::format("{} couples joint '{}': coupled joints are not modelled", what,
                                   printable(name)),
                       "choose a part without it by --base BODY --tip BODY"};
    }
  }

  /// The joints that carry a body up to the world.
  void refuse_carriers(const std::string& name, const XmlElement& by, const std::string& what) {
    int body = tree_.body(name);
    for (std::size_t step = 0; body > 0 && step < tree_.bodies.size(); ++step) {
      for (const TreeJoint& joint : tree_.joints) {
        if (joint.child != body) continue;
        if (joint.type != TreeJointType::kFixed) refuse_joint(joint.name, by, what);
        body = joint.parent;
        break;
      }
    }
  }

  void read_equalities(const XmlElement& equality) {
    for (const XmlElement& own : equality.children) {
      const XmlAttribute* active = own.attribute("active");
      if (active != nullptr && active->value == "false") continue;
      const XmlAttribute* name = own.attribute("name");
      const std::string what =
          fmt::format("equality <{}>{}", printable(own.name),
                      name == nullptr ? "" : " '" + printable(name->value) + "'");
      if (own.name == "joint") {
        for (const std::string_view end : {"joint1", "joint2"}) {
          if (const XmlAttribute* joint = own.attribute(end)) refuse_joint(joint->value, own, what);
        }
      } else if (own.name == "connect" || own.name == "weld") {
        bool any = false;
        for (const std::string_view end : {"body1", "body2"}) {
          const XmlAttribute* body = own.attribute(end);
          if (body == nullptr) continue;
          any = true;
          refuse_carriers(body->value, own, what);
        }
        if (!any) values_.error(own, what + " is not read", "equalities of sites couple bodies");
      } else {
        values_.error(own, what + " is not read", "constraints are not modelled");
      }
    }
  }

  void read_tendons(const XmlElement& tendons) {
    for (const XmlElement& own : tendons.children) {
      const MjcfAttributes attributes = defaults_.of(own, "tendon", "", values_);
      bool acts = false;
      for (const std::string_view name : {"stiffness", "damping", "frictionloss", "armature"}) {
        const XmlAttribute* attribute = attributes.find(name);
        acts = acts || (attribute != nullptr && values_.number(*attribute).value_or(0) != 0);
      }
      if (!acts) continue;  // a way for actuators alone
      const XmlAttribute* name = own.attribute("name");
      const std::string what =
          fmt::format("tendon{}", name == nullptr ? "" : " '" + printable(name->value) + "'");
      if (own.name != "fixed") {
        values_.error(own, what + " pulls, which is not read", "tendons are not modelled");
        continue;
      }
      for (const XmlElement& part : own.children) {
        if (const XmlAttribute* joint = part.attribute("joint")) {
          refuse_joint(joint->value, own, what);
        }
      }
    }
  }

  void read_actuators(const XmlElement& actuators) {
    const XmlElement* first = nullptr;
    std::size_t count = 0;
    for (const XmlElement& own : actuators.children) {
      const MjcfAttributes attributes = defaults_.of(own, own.name, "", values_);
      const XmlAttribute* gear = attributes.find("gear");
      if (gear == nullptr) continue;
      const auto v = values_.numbers(*gear, 1, 6);
      if (!v || (*v)[0] == 1) continue;
      if (first == nullptr) first = &own;
      ++count;
    }
    if (first == nullptr) return;
    values_.warning(*first,
                    count == 1 ? std::string("the gear of an actuator is left out")
                               : fmt::format("the gears of {} actuators are left out", count),
                    "torque is that of the joints: MuJoCo's qfrc_actuator, not ctrl");
  }

  const MjcfDefaults& defaults_;
  XmlValues& values_;
  BodyTree& tree_;
};

}  // namespace

void read_mjcf_couplings(const XmlElement& root, const MjcfDefaults& defaults, XmlValues& values,
                         BodyTree& tree) {
  CouplingReader(defaults, values, tree).read(root);
}

}  // namespace dyngen
