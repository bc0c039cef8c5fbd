// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "gen/bodies/body_judgement.h"
#include "gen/bodies/decimal.h"
#include "gen/robot_output/robot_tree.h"
#include "gen/robot_output/spelled_pose.h"

namespace dyngen {

namespace {

std::string spelled_quaternion(const Matrix3& turn) {
  std::string text;
  for (const Real value : quaternion_of(turn)) {
    constexpr Real kRounding = 1e-17L;
    text += (text.empty() ? "" : " ") + exact_decimal(std::fabs(value) < kRounding ? 0 : value);
  }
  return text;
}

class MjcfWriter {
 public:
  MjcfWriter(BodyTree tree, const RobotFile& file) : tree_(std::move(tree)), file_(file) {
    judge_bodies(tree_, tree_.warnings);
  }

  WrittenRobot write() {
    text_ = fmt::format(
        "<!-- Made by dyngen of a robot file. -->\n<mujoco model=\"{}\">\n"
        "  <compiler angle=\"radian\" autolimits=\"true\"/>\n  <option gravity=\"{}\"/>\n"
        "  <worldbody>\n",
        tree_.name, spelled_vector(-tree_.base_acceleration));
    add_children(0, 2);
    text_ += "  </worldbody>\n</mujoco>\n";
    if (!limits_left_out_.empty()) {
      tree_.warnings.push_back({Severity::kWarning, file_.last_word, 1,
                                fmt::format("limits are left out: {}", limits_left_out_),
                                "joints of MJCF have a range of positions alone"});
    }
    return {std::move(text_), tree_.warnings};
  }

 private:
  void add_children(int parent, std::size_t depth) {
    for (const TreeJoint& joint : tree_.joints) {
      if (joint.parent == parent) add_body(joint, depth);
    }
  }

  void line(std::size_t depth, const std::string& text) {
    text_ += std::string(2 * depth, ' ') + text + "\n";
  }

  void add_body(const TreeJoint& joint, std::size_t depth) {
    const Body& body = tree_.bodies[static_cast<std::size_t>(joint.child)];
    line(depth, fmt::format("<body name=\"{}\" pos=\"{}\" quat=\"{}\">", body.name,
                            spelled_vector(joint.pose.p), spelled_quaternion(joint.pose.R)));
    if (body.has_inertial) add_inertial(body, depth + 1);
    if (joint.type != TreeJointType::kFixed) add_joint(joint, depth + 1);
    add_children(joint.child, depth + 1);
    line(depth, "</body>");
  }

  /// About principal axes, which MuJoCo takes as they are; of a full tensor it finds them itself,
  /// to fewer digits.
  void add_inertial(const Body& body, std::size_t depth) {
    Matrix3 axes = Matrix3::identity();
    Vector3 moments{{body.inertia[0][0], body.inertia[1][1], body.inertia[2][2]}};
    constexpr Real kDiagonal = 1e-16L;
    const Real beside = std::hypot(body.inertia[0][1], body.inertia[0][2], body.inertia[1][2]);
    if (beside > kDiagonal * norm(moments)) moments = principal_moments(body.inertia, &axes);
    line(depth, fmt::format("<inertial pos=\"{}\" quat=\"{}\" mass=\"{}\" diaginertia=\"{}\"/>",
                            spelled_vector(body.centre), spelled_quaternion(axes),
                            exact_decimal(body.mass), spelled_vector(moments)));
  }

  void add_joint(const TreeJoint& joint, std::size_t depth) {
    std::string text = fmt::format("<joint name=\"{}\" type=\"{}\" axis=\"0 0 1\"", joint.name,
                                   joint.type == TreeJointType::kRevolute ? "hinge" : "slide");
    if (joint.lower && joint.upper) {
      text +=
          fmt::format(" range=\"{} {}\"", exact_decimal(*joint.lower), exact_decimal(*joint.upper));
    } else if (joint.lower || joint.upper) {
      tree_.warnings.push_back({Severity::kWarning, joint.limit_place.position,
                                joint.limit_place.length,
                                fmt::format("the one limit of joint '{}' is left out", joint.name),
                                "MJCF has both or none"});
    }
    const auto add = [&](const char* name, Real value) {
      if (value != 0) text += fmt::format(" {}=\"{}\"", name, exact_decimal(value));
    };
    add("armature", joint.armature.value_or(0));
    add("damping", joint.damping.value_or(0));
    add("frictionloss", joint.friction.value_or(0));
    add("stiffness", joint.stiffness);
    add("springref", joint.spring_reference);
    line(depth, text + "/>");
    for (const auto& [value, what] :
         {std::pair{joint.velocity, "vmax"}, std::pair{joint.effort, "taumax"}}) {
      if (!value) continue;
      if (limits_left_out_.find(what) != std::string::npos) continue;
      limits_left_out_ += (limits_left_out_.empty() ? "" : ", ") + std::string(what);
    }
  }

  BodyTree tree_;
  const RobotFile& file_;
  std::string text_, limits_left_out_;
};

}  // namespace

WrittenRobot mjcf_text(const RobotFile& file, const RobotModel& model) {
  return MjcfWriter(robot_tree(file, model, "MJCF"), file).write();
}

}  // namespace dyngen
