// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "gen/bodies/decimal.h"
#include "gen/mjcf/mjcf_pose.h"
#include "gen/robot_output/robot_tree.h"
#include "gen/robot_output/spelled_pose.h"

namespace dyngen {

namespace {

/// What stands for "none" where URDF wants a limit, rad or m.
constexpr Real kFarLimit = 1e9L;

class UrdfWriter {
 public:
  UrdfWriter(BodyTree tree, const RobotFile& file)
      : tree_(std::move(tree)), file_(file), written_{{}, tree_.warnings} {}

  WrittenRobot write() {
    text_ = "<?xml version=\"1.0\"?>\n<!-- Made by dyngen of a robot file. -->\n";
    text_ += fmt::format("<robot name=\"{}\">\n", tree_.name);
    add_world();
    for (const TreeBody& body : tree_.bodies) add_link(body);
    for (const TreeJoint& joint : tree_.joints) add_joint(joint);
    text_ += "</robot>\n";
    written_.text = std::move(text_);
    return std::move(written_);
  }

 private:
  void warn(const TextPlace& place, const std::string& message, const std::string& hint) {
    written_.warnings.push_back({Severity::kWarning, place.position, place.length, message, hint});
  }

  /// URDF's gravity is along -z of the root: where it is not, a link "world" is the root.
  void add_world() {
    const RealVector& up = tree_.base_acceleration;
    const Real size = norm(up);
    const TextPlace place{file_.last_word, 1};
    if (std::fabs(size - kStandardGravity) > kSameLength) {
      warn(place, fmt::format("gravity is {} m/s^2, for which URDF has no field", decimal(size)),
           fmt::format("programs that read URDF take {} or what they are told",
                       decimal(kStandardGravity)));
    }
    if (size == 0 || (up[0] == 0 && up[1] == 0 && up[2] > 0)) return;
    text_ += "  <link name=\"world\"/>\n";
    const RealMatrix turn = transposed(turn_z_to((1 / size) * up));  // of the base, in the world
    text_ += fmt::format(
        "  <joint name=\"world_base\" type=\"fixed\">\n    <origin xyz=\"0 0 0\" rpy=\"{}\"/>\n"
        "    <parent link=\"world\"/>\n    <child link=\"{}\"/>\n  </joint>\n",
        spelled_vector(rpy_of(turn)), tree_.bodies.front().name);
  }

  void add_link(const TreeBody& body) {
    if (!body.has_inertial) {
      text_ += fmt::format("  <link name=\"{}\"/>\n", body.name);
      return;
    }
    const RealMatrix& J = body.inertia;
    text_ += fmt::format(
        "  <link name=\"{}\">\n    <inertial>\n      <origin xyz=\"{}\" rpy=\"0 0 0\"/>\n"
        "      <mass value=\"{}\"/>\n"
        "      <inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" izz=\"{}\"/>\n"
        "    </inertial>\n  </link>\n",
        body.name, spelled_vector(body.centre), exact_decimal(body.mass), exact_decimal(J[0][0]),
        exact_decimal(J[0][1]), exact_decimal(J[0][2]), exact_decimal(J[1][1]),
        exact_decimal(J[1][2]), exact_decimal(J[2][2]));
  }

  void add_joint(const TreeJoint& joint) {
    const bool fixed = joint.type == TreeJointType::kFixed;
    const bool revolute = joint.type == TreeJointType::kRevolute;
    const bool limited = joint.lower || joint.upper;
    const char* type = fixed       ? "fixed"
                       : !revolute ? "prismatic"
                       : limited   ? "revolute"
                                   : "continuous";
    text_ += fmt::format(
        "  <joint name=\"{}\" type=\"{}\">\n    <origin xyz=\"{}\" rpy=\"{}\"/>\n"
        "    <parent link=\"{}\"/>\n    <child link=\"{}\"/>\n",
        joint.name, type, spelled_vector(joint.pose.p), spelled_vector(rpy_of(joint.pose.R)),
        tree_.bodies[static_cast<std::size_t>(joint.parent)].name,
        tree_.bodies[static_cast<std::size_t>(joint.child)].name);
    if (!fixed) {
      text_ += "    <axis xyz=\"0 0 1\"/>\n";
      add_limit(joint, limited || !revolute);
      if (joint.damping.value_or(0) != 0 || joint.friction.value_or(0) != 0) {
        text_ += fmt::format("    <dynamics damping=\"{}\" friction=\"{}\"/>\n",
                             exact_decimal(joint.damping.value_or(0)),
                             exact_decimal(joint.friction.value_or(0)));
      }
      if (joint.armature.value_or(0) != 0) {
        warn(joint.dynamics_place,
             fmt::format("IA of joint '{}' ({}) is left out", joint.name, decimal(*joint.armature)),
             "URDF has no field for the inertia of rotors; MJCF has (--to-mjcf)");
      }
    }
    text_ += "  </joint>\n";
  }

  /// 0 stands for an effort or velocity that is not known.
  void add_limit(const TreeJoint& joint, bool positions) {
    if (!positions && !joint.effort && !joint.velocity) return;
    std::string range;
    if (positions) {
      if (!joint.lower || !joint.upper) {
        warn(joint.limit_place,
             fmt::format("joint '{}' has no limit to {}: {} stands for it", joint.name,
                         joint.lower ? "one side" : "either side", decimal(kFarLimit)),
             "URDF wants limits of such a joint");
      }
      range =
          fmt::format("lower=\"{}\" upper=\"{}\" ", exact_decimal(joint.lower.value_or(-kFarLimit)),
                      exact_decimal(joint.upper.value_or(kFarLimit)));
    }
    text_ += fmt::format("    <limit {}effort=\"{}\" velocity=\"{}\"/>\n", range,
                         exact_decimal(joint.effort.value_or(0)),
                         exact_decimal(joint.velocity.value_or(0)));
  }

  BodyTree tree_;
  const RobotFile& file_;
  WrittenRobot written_;
  std::string text_;
};

}  // namespace

WrittenRobot urdf_text(const RobotFile& file, const RobotModel& model) {
  return UrdfWriter(robot_tree(file, model, "URDF"), file).write();
}

}  // namespace dyngen
