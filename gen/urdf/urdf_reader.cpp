// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/urdf/urdf_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gen/bodies/body_judgement.h"
#include "gen/bodies/decimal.h"
#include "gen/urdf/urdf_words.h"
#include "gen/xml/xml_values.h"

namespace dyngen {

namespace {

TextPlace place_in_urdf(const XmlElement& element) { return {element.position, element.length}; }

template <std::size_t N>
bool stands_among(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Elements without dynamics, or of other programs.
constexpr std::array<std::string_view, 8> kPassedInRobot = {"material", "transmission", "gazebo",
                                                            "sensor",   "ros2_control", "mujoco",
                                                            "group",    "self_collide"};
constexpr std::array<std::string_view, 5> kPassedInLink = {"visual", "collision", "sensor",
                                                           "contact", "self_collision_checking"};
constexpr std::array<std::string_view, 9> kKnownInJoint = {
    "origin",     "parent", "child", "axis", "limit", "mimic", "dynamics", "safety_controller",
    "calibration"};

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
        options_(options),
        diagnostics_(document.file_name, document.text),
        values_(document, diagnostics_) {}

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
      if (child.name == "joint") read_joint(child);
      if (child.name == "gazebo") read_gazebo(child);
      if (child.name == "transmission") read_transmission(child);
      const bool known =
          child.name == "link" || child.name == "joint" || stands_among(child.name, kPassedInRobot);
      if (!known) warn_of_unknown(child, "the robot");
    }
    throw_if_wrong();
    check_is_tree();
    throw_if_wrong();
    tree_.warnings = diagnostics_.all();
    judge_bodies(tree_, tree_.warnings);
    return std::move(tree_);
  }

 private:
  void throw_if_wrong() const {
    if (diagnostics_.has_errors()) throw ModelError(diagnostics_.render());
  }

  void warn_of_unknown(const XmlElement& element, const std::string& where) {
    values_.warning(
        element, fmt::format("<{}> in {} is unknown and left out", printable(element.name), where),
        "its dynamics, if it has any, are not in the model");
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

  // ---- values

  RealVector vector(const XmlElement& element, std::string_view name, const RealVector& absent) {
    const XmlAttribute* attribute = element.attribute(name);
    if (attribute == nullptr) return absent;
    const auto values = values_.numbers(*attribute, 3);
    if (!values) return absent;
    return {{(*values)[0], (*values)[1], (*values)[2]}};
  }

  /// Angles within the tolerance are multiples of pi/12; nearly right ones are warned of.
  RealVector angles(const XmlElement& element, const std::string& whose) {
    constexpr Real kNearlyRight = 1e-3L;  // rad: rounded by hand, rather than calibrated
    RealVector rpy = vector(element, "rpy", {});
    const XmlAttribute* attribute = element.attribute("rpy");
    for (std::size_t k = 0; k < 3; ++k) {
      const Real tolerance = std::max(kSameAngle, options_.round_angles);
      const Real written = rpy[k];
      if (std::fabs(written) > 2 * kRealPi + kNearlyRight && attribute != nullptr) {
        values_.warning(
            *attribute,
            fmt::format("rpy of {}: {} rad is more than a turn", whose, decimal(written)),
            "URDF's angles are in rad: is it in degrees?");
      }
      rpy[k] = rounded_angle(written, tolerance);
      const Real right = std::round(written / (kRealPi / 2)) * (kRealPi / 2);
      const bool nearly = right != 0 && rpy[k] == written && written != right &&
                          std::fabs(written - right) < kNearlyRight;
      if (!nearly || attribute == nullptr) continue;
      values_.warning(*attribute,
                      fmt::format("rpy of {}: {} is nearly, but not exactly, {}", whose,
                                  decimal(written), angle_text(right)),
                      fmt::format("it is kept as it is, which costs operations in every function; "
                                  "--round-angles {:.0e} makes it a right angle",
                                  power_of_ten_above(std::fabs(written - right))));
    }
    return rpy;
  }

  static double power_of_ten_above(Real value) {
    return std::pow(10.0, std::ceil(std::log10(static_cast<double>(value))));
  }

  RigidPose origin(const XmlElement& element, const std::string& whose) {
    const XmlElement* child = only_child(element, "origin");
    if (child == nullptr) return {};
    return {turn_rpy(angles(*child, whose)), vector(*child, "xyz", {})};
  }

  /// A child that may stand once.
  const XmlElement* only_child(const XmlElement& element, std::string_view name) {
    const XmlElement* first = nullptr;
    for (const XmlElement& child : element.children) {
      if (child.name != name) continue;
      if (first != nullptr) {
        values_.error(child,
                      fmt::format("<{}> stands twice in <{}>", name, printable(element.name)),
                      fmt::format("the first is on line {}", first->position.line));
      }
      if (first == nullptr) first = &child;
    }
    return first;
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
    if (const XmlElement* inertial = only_child(element, "inertial")) {
      read_inertial(*inertial, body);
    }
    for (const XmlElement& child : element.children) {
      if (child.name == "inertial" || stands_among(child.name, kPassedInLink)) continue;
      warn_of_unknown(child, fmt::format("link '{}'", printable(body.name)));
    }
    tree_.bodies.push_back(std::move(body));
  }

  void read_inertial(const XmlElement& element, TreeBody& body) {
    const std::string whose = fmt::format("the inertial of link '{}'", printable(body.name));
    body.has_inertial = true;
    body.inertial_place = place_in_urdf(element);
    const RigidPose frame = origin(element, whose);
    body.centre = frame.p;
    const XmlElement* mass = only_child(element, "mass");
    const XmlElement* inertia = only_child(element, "inertia");
    if (mass == nullptr)
      values_.error(element, whose + " has no <mass>", "expected <mass value=\"1\"/>");
    if (inertia == nullptr) {
      values_.error(element, whose + " has no <inertia>",
                    "expected <inertia ixx=\"\" ixy=\"\" ixz=\"\" iyy=\"\" iyz=\"\" izz=\"\"/>");
    }
    for (const XmlElement& child : element.children) {
      if (child.name != "origin" && child.name != "mass" && child.name != "inertia") {
        warn_of_unknown(child, whose);
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

  // ---- joints

  void read_joint(const XmlElement& element) {
    const XmlAttribute* name = values_.required(element, "name", "a joint");
    if (name == nullptr) return;
    TreeJoint joint;
    joint.name = name->value;
    const std::string whose = fmt::format("joint '{}'", printable(joint.name));
    joint.place = joint.pose_place = joint.limit_place = joint.dynamics_place =
        place_in_urdf(element);
    const auto [first, is_first] = joint_of_.emplace(joint.name, element.position.line);
    if (!is_first) {
      values_.error(*name, whose + " stands twice",
                    fmt::format("the first is on line {}", first->second));
    }
    const bool continuous = read_type(element, whose, joint);
    if (const XmlElement* mimic = only_child(element, "mimic")) {
      const XmlAttribute* other = mimic->attribute("joint");
      joint.refusal = {Severity::kError, mimic->position, mimic->length,
                       fmt::format("{} mimics joint '{}': joints that are coupled are not modelled",
                                   whose, other == nullptr ? "?" : printable(other->value)),
                       "make it fixed, or choose a part without it by --base LINK --tip LINK"};
    }
    joint.parent = read_end(element, "parent", whose);
    joint.child = read_end(element, "child", whose);
    joint.pose = origin(element, whose);
    if (const XmlElement* own = element.child("origin")) joint.pose_place = place_in_urdf(*own);
    if (joint.type == TreeJointType::kFixed) joint.refusal.reset();
    if (joint.type != TreeJointType::kFixed && !joint.refusal) {
      read_axis(element, whose, joint);
      read_limits(element, whose, continuous, joint);
      read_dynamics(element, joint);
    }
    for (const XmlElement& child : element.children) {
      if (!stands_among(child.name, kKnownInJoint)) warn_of_unknown(child, whose);
    }
    tree_.joints.push_back(std::move(joint));
  }

  /// @return  whether it is continuous
  bool read_type(const XmlElement& element, const std::string& whose, TreeJoint& joint) {
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
          *type,
          fmt::format("{} has the type '{}', which is unknown", whose, printable(type->value)),
          "expected revolute, continuous, prismatic or fixed");
    }
    return type->value == "continuous";
  }

  int read_end(const XmlElement& element, std::string_view end, const std::string& whose) {
    const XmlElement* child = only_child(element, end);
    if (child == nullptr) {
      values_.error(element, fmt::format("{} has no <{}>", whose, end),
                    fmt::format("expected <{} link=\"...\"/>", end));
      return -1;
    }
    const XmlAttribute* link =
        values_.required(*child, "link", fmt::format("<{}> of {}", end, whose));
    if (link == nullptr) return -1;
    const auto found = link_of_.find(link->value);
    if (found != link_of_.end()) return static_cast<int>(found->second);
    values_.error(*link,
                  fmt::format("the {} of {} is link '{}', which does not exist", end, whose,
                              printable(link->value)),
                  "expected the name of a <link>");
    return -1;
  }

  void read_axis(const XmlElement& element, const std::string& whose, TreeJoint& joint) {
    const XmlElement* child = only_child(element, "axis");
    joint.axis = {{1, 0, 0}};
    if (child == nullptr) return;
    const XmlAttribute* xyz = values_.required(*child, "xyz", "the axis of " + whose);
    if (xyz == nullptr) return;
    const RealVector axis = vector(*child, "xyz", joint.axis);
    const Real length = norm(axis);
    if (length == 0) {
      values_.error(*xyz, fmt::format("the axis of {} has no length", whose),
                    "expected a direction: <axis xyz=\"0 0 1\"/>");
      return;
    }
    joint.axis = (1 / length) * axis;
  }

  void read_limits(const XmlElement& element, const std::string& whose, bool continuous,
                   TreeJoint& joint) {
    const XmlElement* limit = only_child(element, "limit");
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

  void read_dynamics(const XmlElement& element, TreeJoint& joint) {
    const XmlElement* dynamics = only_child(element, "dynamics");
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

  // ---- the whole

  void check_is_tree() {
    std::vector<const TreeJoint*> carrier(tree_.bodies.size(), nullptr);
    for (const TreeJoint& joint : tree_.joints) {
      const TreeJoint*& own = carrier[static_cast<std::size_t>(joint.child)];
      const TreeBody& body = tree_.bodies[static_cast<std::size_t>(joint.child)];
      if (own != nullptr) {
        diagnostics_.error(
            joint.place.position, joint.place.length,
            fmt::format("link '{}' is the child of joint '{}' and of joint '{}'",
                        printable(body.name), printable(own->name), printable(joint.name)),
            "a link has one parent: closed loops are not modelled");
        continue;
      }
      own = &joint;
    }
    if (diagnostics_.has_errors()) return;
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < carrier.size(); ++i) {
      if (carrier[i] == nullptr) roots.push_back(i);
    }
    if (roots.empty()) {
      values_.error(document_.root, "the robot has no root: its links hang on each other in a loop",
                    "expected one link that is no joint's child");
      return;
    }
    if (roots.size() > 1) {
      const TreeBody& second = tree_.bodies[roots[1]];
      diagnostics_.error(
          second.place.position, second.place.length,
          fmt::format("the robot has {} roots: links '{}' and '{}' hang on no joint", roots.size(),
                      printable(tree_.bodies[roots[0]].name), printable(second.name)),
          "join them by fixed joints");
      return;
    }
    check_no_loop(carrier);
  }

  void check_no_loop(const std::vector<const TreeJoint*>& carrier) {
    for (std::size_t i = 0; i < carrier.size(); ++i) {
      std::size_t body = i;
      for (std::size_t step = 0; step <= carrier.size() && carrier[body] != nullptr; ++step) {
        body = static_cast<std::size_t>(carrier[body]->parent);
      }
      if (carrier[body] == nullptr) continue;
      const TreeJoint& joint = *carrier[i];
      diagnostics_.error(joint.place.position, joint.place.length,
                         fmt::format("joint '{}' is part of a loop: link '{}' hangs on itself",
                                     printable(joint.name), printable(tree_.bodies[i].name)),
                         "expected a tree");
      return;
    }
  }

  const XmlDocument& document_;
  ReadingOptions options_;
  Diagnostics diagnostics_;
  XmlValues values_;
  BodyTree tree_;
  std::map<std::string, std::size_t> link_of_;
  std::map<std::string, int> joint_of_;  // lines
};

}  // namespace

BodyTree read_urdf(const XmlDocument& document, const ReadingOptions& options) {
  return UrdfReader(document, options).read();
}

}  // namespace dyngen
