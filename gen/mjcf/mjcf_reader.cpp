// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/mjcf/mjcf_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gen/bodies/body_judgement.h"
#include "gen/mjcf/geom_inertia.h"
#include "gen/mjcf/mjcf_defaults.h"
#include "gen/mjcf/mjcf_settings.h"
#include "gen/mjcf/mjcf_words.h"

namespace dyngen {

namespace {

TextPlace place_in_mjcf(const XmlElement& element) { return {element.position, element.length}; }

constexpr std::array<std::string_view, 7> kRefusedElements = {
    "include", "replicate", "attach", "composite", "flexcomp", "plugin", "dynamic_body"};

std::string way_out_of(std::string_view element) {
  if (element == "plugin") return "what a plugin does to torque is not known";
  return "write the bodies out: MuJoCo does where it saves a loaded model (mj_saveLastXML)";
}

class MjcfReader {
 public:
  MjcfReader(const XmlDocument& document, const ReadingOptions& options)
      : document_(document),
        diagnostics_(document.file_name, document.text),
        values_(document, diagnostics_),
        settings_(read_mjcf_settings(document.root, options, values_)),
        defaults_(document.root, values_) {}

  BodyTree read() {
    const XmlElement& root = document_.root;
    tree_.format = "MJCF";
    tree_.place = place_in_mjcf(root);
    tree_.gravity_place = settings_.gravity_place;
    tree_.base_acceleration = -settings_.gravity;
    if (const XmlAttribute* name = root.attribute("model")) tree_.name = name->value;
    TreeBody world;
    world.name = "world";
    world.place = world.inertial_place = place_in_mjcf(root);
    tree_.bodies.push_back(std::move(world));
    bool any = false;
    check_mjcf_words(root, values_);
    for (const XmlElement& child : root.children) {
      refuse_element(child);
      if (child.name != "worldbody") continue;
      any = true;
      read_children(child, 0, RigidPose{}, "");
    }
    if (!any) values_.error(root, "the model has no <worldbody>", "expected bodies");
    for (const XmlElement& child : root.children) {
      if (child.name == "equality") read_equalities(child);
      if (child.name == "tendon") read_tendons(child);
      if (child.name == "actuator") read_actuators(child);
    }
    if (diagnostics_.has_errors()) throw ModelError(diagnostics_.render());
    set_total_mass();
    tree_.warnings = diagnostics_.all();
    judge_bodies(tree_, tree_.warnings);
    return std::move(tree_);
  }

 private:
  // ---- bodies

  bool refuse_element(const XmlElement& element) {
    const bool refused = std::find(kRefusedElements.begin(), kRefusedElements.end(),
                                   element.name) != kRefusedElements.end();
    if (refused) {
      values_.error(element, fmt::format("<{}> is not read", element.name),
                    way_out_of(element.name));
    }
    return refused;
  }

  /// Bodies of a body or a frame. @param around  of the element's frame in the body's
  void read_children(const XmlElement& element, int body, const RigidPose& around,
                     const std::string& given_class) {
    for (const XmlElement& child : element.children) {
      if (refuse_element(child)) continue;
      if (child.name == "body") read_body(child, body, around, given_class);
      if (child.name == "frame") {
        read_children(child, body, around * frame_pose(child), class_inside(child, given_class));
      }
    }
  }

  RigidPose frame_pose(const XmlElement& element) {
    MjcfAttributes attributes;
    attributes.take(element);
    return mjcf_pose(attributes, settings_.angles, values_);
  }

  std::string class_inside(const XmlElement& element, const std::string& given_class) {
    const XmlAttribute* own = element.attribute("childclass");
    if (own == nullptr) return given_class;
    if (!defaults_.has(own->value)) {
      values_.error(*own, fmt::format("default class '{}' does not exist", printable(own->value)),
                    "expected the class of a <default>");
    }
    return own->value;
  }

  /// What of a body stands in it or in frames in it.
  struct Contents {
    struct Item {
      const XmlElement* element = nullptr;
      RigidPose around{};
      std::string given_class;
    };
    std::vector<Item> joints, geoms;
    const XmlElement* inertial = nullptr;
  };

  void collect(const XmlElement& element, const RigidPose& around, const std::string& given_class,
               Contents& contents) {
    for (const XmlElement& child : element.children) {
      if (child.name == "joint" || child.name == "freejoint") {
        contents.joints.push_back({&child, around, given_class});
      } else if (child.name == "geom") {
        contents.geoms.push_back({&child, around, given_class});
      } else if (child.name == "inertial") {
        contents.inertial = &child;
      } else if (child.name == "frame") {
        collect(child, around * frame_pose(child), class_inside(child, given_class), contents);
      }
    }
  }

  void read_body(const XmlElement& element, int parent, const RigidPose& around,
                 const std::string& given_class) {
    if (tree_.bodies.size() > static_cast<std::size_t>(kMaxBodies)) {
      values_.error(element, "too many bodies", fmt::format("at most {} are read", kMaxBodies));
      return;
    }
    const std::string inside = class_inside(element, given_class);
    TreeBody body;
    body.place = body.inertial_place = place_in_mjcf(element);
    const XmlAttribute* name = element.attribute("name");
    body.name = name != nullptr ? name->value : fmt::format("body{}", tree_.bodies.size());
    if (!names_of_bodies_.emplace(body.name, element.position.line).second ||
        body.name == "world") {
      values_.error(element, fmt::format("body '{}' stands twice", printable(body.name)),
                    "each body has a name of its own");
    }
    if (const XmlAttribute* gravity = element.attribute("gravcomp")) {
      if (values_.number(*gravity).value_or(0) != 0) {
        values_.warning(*gravity,
                        fmt::format("gravcomp of body '{}' is left out", printable(body.name)),
                        "the model has the whole weight");
      }
    }
    Contents contents;
    collect(element, RigidPose{}, inside, contents);
    read_inertia(contents, body);
    const RigidPose pose = around * frame_pose(element);
    const int own = add_body(std::move(body), contents, parent, pose);
    read_children(element, own, RigidPose{}, inside);
  }

  /// @return  the body's place
  int add_body(TreeBody body, const Contents& contents, int parent, const RigidPose& pose) {
    std::vector<TreeJoint> joints;
    for (const Contents::Item& item : contents.joints)
      joints.push_back(read_joint(item, body.name));
    if (joints.empty()) {
      TreeJoint fixed;
      fixed.name = body.name + "_fixed";
      fixed.place = fixed.pose_place = fixed.limit_place = fixed.dynamics_place = body.place;
      joints.push_back(std::move(fixed));
    }
    RigidPose step = pose;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      TreeJoint& joint = joints[i];
      const bool last = i + 1 == joints.size();
      joint.parent = parent;
      joint.child = static_cast<int>(tree_.bodies.size());
      joint.pose = step * from_reference(joint, references_of_[joint.name]);
      step = RigidPose{};
      if (last) {
        tree_.bodies.push_back(std::move(body));
      } else {
        TreeBody between;
        between.name = fmt::format("{}_{}", body.name, i + 1);
        between.place = between.inertial_place = joint.place;
        tree_.bodies.push_back(std::move(between));
      }
      parent = joint.child;
      tree_.joints.push_back(std::move(joint));
    }
    return parent;
  }

  /// At q = ref the body stands as it is described.
  static RigidPose from_reference(const TreeJoint& joint, Real reference) {
    if (reference == 0) return {};
    if (joint.type == TreeJointType::kPrismatic) {
      return {RealMatrix::identity(), -reference * joint.axis};
    }
    const RealMatrix turn = turn_about(joint.axis, -reference);
    return {turn, joint.point - turn * joint.point};
  }

  // ---- joints

  TreeJoint read_joint(const Contents::Item& item, const std::string& body) {
    const XmlElement& element = *item.element;
    const MjcfAttributes own = defaults_.of(element, "joint", item.given_class, values_);
    TreeJoint joint;
    joint.place = joint.pose_place = joint.limit_place = joint.dynamics_place =
        place_in_mjcf(element);
    const XmlAttribute* name = own.find("name");
    const std::size_t number = ++joints_without_name_[body];
    joint.name = name != nullptr ? name->value
                 : number == 1   ? body + "_joint"
                                 : fmt::format("{}_joint{}", body, number);
    if (!names_of_joints_.emplace(joint.name, element.position.line).second) {
      values_.error(element, fmt::format("joint '{}' stands twice", printable(joint.name)),
                    "each joint has a name of its own");
    }
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
      return joint;
    }
    if (kind != "hinge" && kind != "slide") {
      values_.error(*type,
                    fmt::format("joint '{}' has the type '{}', which is unknown",
                                printable(joint.name), printable(kind)),
                    "expected hinge or slide");
    }
    read_axis(own, element, item.around, joint);
    read_range(own, joint);
    read_dynamics(own, joint);
    return joint;
  }

  void read_axis(const MjcfAttributes& own, const XmlElement& element, const RigidPose& around,
                 TreeJoint& joint) {
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
    references_of_[joint.name] = coordinate(own, "ref", joint);
  }

  /// An angle, or of a slide a length. 0 if it is missing.
  Real coordinate(const MjcfAttributes& own, std::string_view name, const TreeJoint& joint) {
    const XmlAttribute* attribute = own.find(name);
    if (attribute == nullptr) return 0;
    const Real value = values_.number(*attribute).value_or(0);
    return joint.type == TreeJointType::kPrismatic ? value : mjcf_angle(value, settings_.angles);
  }

  void read_range(const MjcfAttributes& own, TreeJoint& joint) {
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

  std::optional<Real> magnitude(const MjcfAttributes& own, std::string_view name,
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

  void read_dynamics(const MjcfAttributes& own, TreeJoint& joint) {
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

  // ---- inertia

  void read_inertia(const Contents& contents, TreeBody& body) {
    const bool given = contents.inertial != nullptr && settings_.inertia != InertiaSource::kGeoms;
    if (given) {
      read_inertial(*contents.inertial, body);
    } else if (settings_.inertia != InertiaSource::kInertial) {
      add_geoms(contents, body);
    }
    bound(body);
  }

  void read_inertial(const XmlElement& element, TreeBody& body) {
    MjcfAttributes own;
    own.take(element);
    const std::string whose = fmt::format("the inertial of body '{}'", printable(body.name));
    body.has_inertial = true;
    body.inertial_place = place_in_mjcf(element);
    const RigidPose pose = mjcf_pose(own, settings_.angles, values_);
    values_.required(element, "pos", whose);
    body.centre = pose.p;
    if (const XmlAttribute* mass = values_.required(element, "mass", whose)) {
      body.mass = values_.number(*mass).value_or(0);
    }
    RealMatrix tensor;
    if (const XmlAttribute* full = own.find("fullinertia")) {
      if (const auto v = values_.numbers(*full, 6)) {
        for (std::size_t k = 0; k < 3; ++k) tensor[k][k] = (*v)[k];
        tensor[0][1] = tensor[1][0] = (*v)[3];
        tensor[0][2] = tensor[2][0] = (*v)[4];
        tensor[1][2] = tensor[2][1] = (*v)[5];
      }
    } else if (const auto diagonal = mjcf_vector(own, "diaginertia", values_)) {
      for (std::size_t k = 0; k < 3; ++k) tensor[k][k] = (*diagonal)[k];
    } else {
      values_.error(element, whose + " has neither diaginertia nor fullinertia",
                    "expected one of them");
    }
    body.inertia = turned(pose.R, tensor);
  }

  void add_geoms(const Contents& contents, TreeBody& body) {
    std::vector<GeomInertia> solids;
    for (const Contents::Item& item : contents.geoms) {
      const MjcfAttributes own = defaults_.of(*item.element, "geom", item.given_class, values_);
      const XmlAttribute* group = own.find("group");
      const Real number = group == nullptr ? 0 : values_.number(*group).value_or(0);
      if (number < settings_.first_group || number > settings_.last_group) continue;
      const auto solid = geom_inertia(*item.element, own, item.around, settings_.angles, values_);
      if (solid && solid->mass != 0) solids.push_back(*solid);
    }
    for (const GeomInertia& solid : solids) {
      body.mass += solid.mass;
      body.centre = body.centre + solid.mass * solid.centre;
    }
    if (body.mass == 0) return;
    body.has_inertial = true;
    body.centre = (1 / body.mass) * body.centre;
    for (const GeomInertia& solid : solids) {
      body.inertia =
          body.inertia + solid.inertia + parallel_axes(solid.mass, solid.centre - body.centre);
    }
  }

  /// What <compiler> makes of masses and moments, in MuJoCo's order.
  void bound(TreeBody& body) const {
    body.mass = std::max(body.mass, settings_.least_mass);
    if (settings_.least_moment <= 0 && !settings_.balance_inertia) return;
    RealMatrix axes;
    RealVector p = principal_moments(body.inertia, &axes);
    bool changed = false;
    for (std::size_t k = 0; k < 3; ++k) {
      changed = changed || p[k] < settings_.least_moment;
      p[k] = std::max(p[k], settings_.least_moment);
    }
    if (settings_.balance_inertia && p[0] + p[1] < p[2]) {
      const Real mean = (p[0] + p[1] + p[2]) / 3;
      p = {{mean, mean, mean}};
      changed = true;
    }
    if (!changed) return;
    RealMatrix diagonal;
    for (std::size_t k = 0; k < 3; ++k) diagonal[k][k] = p[k];
    body.inertia = turned(axes, diagonal);
  }

  void set_total_mass() {
    if (settings_.total_mass <= 0) return;
    Real sum = 0;
    for (const TreeBody& body : tree_.bodies) sum += body.mass;
    if (sum == 0) return;
    const Real factor = settings_.total_mass / sum;
    for (TreeBody& body : tree_.bodies) {
      body.mass *= factor;
      body.inertia = factor * body.inertia;
    }
  }

  // ---- what couples joints

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

  const XmlDocument& document_;
  Diagnostics diagnostics_;
  XmlValues values_;
  MjcfSettings settings_;
  MjcfDefaults defaults_;
  BodyTree tree_;
  std::map<std::string, int> names_of_bodies_, names_of_joints_;  // lines
  std::map<std::string, std::size_t> joints_without_name_;        // of each body
  std::map<std::string, Real> references_of_;                     // of joints, by name
};

}  // namespace

BodyTree read_mjcf(const XmlDocument& document, const ReadingOptions& options) {
  return MjcfReader(document, options).read();
}

}  // namespace dyngen
