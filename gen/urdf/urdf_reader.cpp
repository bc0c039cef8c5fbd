// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/urdf/urdf_reader.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "gen/bodies/body_judgement.h"
#include "gen/urdf/tree_check.h"
#include "gen/urdf/urdf_elements.h"
#include "gen/urdf/urdf_joints.h"
#include "gen/urdf/urdf_words.h"
#include "gen/xml/xml_values.h"

namespace dyngen {
namespace {

/// Elements without dynamics, or of other programs.
constexpr std::array<std::string_view, 8> kPassedInRobot = {"material", "transmission", "gazebo",
                                                            "sensor",   "ros2_control", "mujoco",
                                                            "group",    "self_collide"};
constexpr std::array<std::string_view, 5> kPassedInLink = {"visual", "collision", "sensor",
                                                           "contact", "self_collision_checking"};

/// What URDF's extensions call an inertia of rotors, which no field of URDF itself has.
bool speaks_of_rotors(std::string_view name) {
  return name.find("otor_inertia") != name.npos || name.find("otorInertia") != name.npos ||
         name.find("armature") != name.npos;
}

/// What gazebo adds to joints and links that changes torque.
constexpr std::array<std::string_view, 6> kGazeboDynamics = {
    "springStiffness", "springReference", "implicitSpringDamper",
    "turnGravityOff",  "gravity",         "selfForce"};

class UrdfReader {
 public:
  UrdfReader(const XmlDocument& document, const ReadingOptions& options)
      : document_(document),
        diagnostics_(document.file_name, document.text),
        values_(document, diagnostics_),
        elements_(options, values_),
        joints_(link_of_, elements_) {}

  BodyTree read() {
    const XmlElement& robot = document_.root;
    refuse_xacro(robot);
    tree_.format = "URDF";
    tree_.place = tree_.gravity_place = place_in_urdf(robot);
    tree_.base_acceleration = {{0, 0, kStandardGravity}};
    if (const XmlAttribute* name = robot.attribute("name")) tree_.name = name->value;
    check_urdf_attributes(robot, values_);
    for (const XmlElement& child : robot.children) {
      if (child.name == "link") read_link(child);
    }
    if (tree_.bodies.empty()) values_.error(robot, "the robot has no <link>", "expected links");
    if (tree_.bodies.size() > static_cast<std::size_t>(kMaxBodies)) {
      values_.error(robot, fmt::format("the robot has {} links", tree_.bodies.size()),
                    fmt::format("at most {} are read", kMaxBodies));
    }
    for (const XmlElement& child : robot.children) {
      if (child.name == "joint") {
        if (auto joint = joints_.read(child)) tree_.joints.push_back(std::move(*joint));
      }
      if (child.name == "gazebo") read_gazebo(child);
      if (child.name == "transmission") read_transmission(child);
      const bool known =
          child.name == "link" || child.name == "joint" || stands_among(child.name, kPassedInRobot);
      if (!known) elements_.warn_of_unknown(child, "the robot");
    }
    throw_if_wrong();
    check_is_tree(tree_, diagnostics_);
    throw_if_wrong();
    tree_.warnings = diagnostics_.all();
    judge_bodies(tree_, tree_.warnings);
    return std::move(tree_);
  }

 private:
  void throw_if_wrong() const {
    if (diagnostics_.has_errors()) throw ModelError(diagnostics_.render());
  }

  void refuse_xacro(const XmlElement& element) {
    const XmlElement* found = first_xacro(element);
    if (found == nullptr) return;
    const std::string file = std::filesystem::path(document_.file_name).filename().string();
    std::string stem = file;
    for (const std::string_view ending : {".xacro", ".urdf", ".xml"}) {
      if (stem.ends_with(ending)) stem.erase(stem.rfind(ending));
    }
    const std::string source = stem + ".urdf" == file ? stem + ".urdf.xacro" : file;
    values_.error(
        *found,
        fmt::format("this is a xacro file: <{}> has to be expanded first", printable(found->name)),
        fmt::format("xacro {} > {}.urdf", printable(source), printable(stem)));
    throw_if_wrong();
  }

  /// An element or an attribute that xacro replaces, or null.
  static const XmlElement* first_xacro(const XmlElement& element) {
    if (element.name.starts_with("xacro:")) return &element;
    for (const XmlAttribute& attribute : element.attributes) {
      if (attribute.value.find("${") != std::string::npos ||
          attribute.value.find("$(") != std::string::npos) {
        return &element;
      }
    }
    for (const XmlElement& child : element.children) {
      if (const XmlElement* found = first_xacro(child)) return found;
    }
    return nullptr;
  }

  // ---- links

  void read_link(const XmlElement& element) {
    const XmlAttribute* name = values_.required(element, "name", "a link");
    if (name == nullptr) return;
    TreeBody body;
    body.name = name->value;
    body.place = body.inertial_place = place_in_urdf(element);
    const auto [first, is_first] = link_of_.emplace(body.name, tree_.bodies.size());
    if (!is_first) {
      values_.error(
          *name, fmt::format("link '{}' stands twice", printable(body.name)),
          fmt::format("the first is on line {}", tree_.bodies[first->second].place.position.line));
      return;
    }
    if (const XmlElement* inertial = elements_.only_child(element, "inertial")) {
      read_inertial(*inertial, body);
    }
    for (const XmlElement& child : element.children) {
      if (child.name == "inertial" || stands_among(child.name, kPassedInLink)) continue;
      elements_.warn_of_unknown(child, fmt::format("link '{}'", printable(body.name)));
    }
    tree_.bodies.push_back(std::move(body));
  }

  void read_inertial(const XmlElement& element, TreeBody& body) {
    const std::string whose = fmt::format("the inertial of link '{}'", printable(body.name));
    body.has_inertial = true;
    body.inertial_place = place_in_urdf(element);
    const RigidPose frame = elements_.origin(element, whose);
    body.centre = frame.p;
    const XmlElement* mass = elements_.only_child(element, "mass");
    const XmlElement* inertia = elements_.only_child(element, "inertia");
    if (mass == nullptr)
      values_.error(element, whose + " has no <mass>", "expected <mass value=\"1\"/>");
    if (inertia == nullptr) {
      values_.error(element, whose + " has no <inertia>",
                    "expected <inertia ixx=\"\" ixy=\"\" ixz=\"\" iyy=\"\" iyz=\"\" izz=\"\"/>");
    }
    for (const XmlElement& child : element.children) {
      if (child.name != "origin" && child.name != "mass" && child.name != "inertia") {
        elements_.warn_of_unknown(child, whose);
      }
    }
    if (mass != nullptr) {
      if (const XmlAttribute* value = values_.required(*mass, "value", "the mass of " + whose)) {
        body.mass = values_.number(*value).value_or(0);
      }
    }
    if (inertia == nullptr) return;
    RealMatrix own;
    constexpr std::array<std::string_view, 6> kNames = {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"};
    constexpr std::array<std::pair<std::size_t, std::size_t>, 6> kPlaces = {
        {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      const XmlAttribute* value = values_.required(*inertia, kNames[i], whose);
      if (value == nullptr) continue;
      const auto [row, column] = kPlaces[i];
      own[row][column] = own[column][row] = values_.number(*value).value_or(0);
    }
    body.inertia = turned(frame.R, own);
  }

  // ---- what has dynamics beside links and joints

  void read_gazebo(const XmlElement& element) {
    const XmlAttribute* reference = element.attribute("reference");
    for (const XmlElement& child : element.children) {
      if (!stands_among(child.name, kGazeboDynamics)) continue;
      values_.warning(
          child,
          fmt::format(
              "<{}> of <gazebo{}> is left out", printable(child.name),
              reference == nullptr ? "" : " reference=\"" + printable(reference->value) + "\""),
          "what it does to torque is not in the model");
    }
  }

  void read_transmission(const XmlElement& element) {
    for (const XmlElement& child : element.children) {
      if (speaks_of_rotors(child.name)) {
        values_.warning(child,
                        fmt::format("<{}> of <transmission> is left out", printable(child.name)),
                        "write the rotor's inertia, times its gear ratio squared, in the row IA of "
                        "a robot file (--to-robot)");
      }
      read_transmission(child);
    }
  }

  const XmlDocument& document_;
  Diagnostics diagnostics_;
  XmlValues values_;
  UrdfElements elements_;
  BodyTree tree_;
  std::map<std::string, std::size_t> link_of_;
  UrdfJoints joints_;
};

}  // namespace

BodyTree read_urdf(const XmlDocument& document, const ReadingOptions& options) {
  return UrdfReader(document, options).read();
}

}  // namespace dyngen
