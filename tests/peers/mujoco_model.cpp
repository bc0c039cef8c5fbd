// SPDX-License-Identifier: MIT
#include "tests/peers/mujoco_model.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <string>

#include "tests/peers/link_frames.h"
#include "tests/support/mujoco_text.h"

namespace dyngen::test {
namespace {

/// A body with its joint and its children. set_inertia() sets its inertia afterwards: MuJoCo's
/// compiler refuses some that published robots have, and finds principal axes to 1e-8 only.
std::string body_text(const NumericRobot& robot, std::size_t j) {
  const NumericJoint& joint = robot.joints[j];
  const LinkFrames frames = link_frames(robot, j);
  const Eigen::Isometry3d place = frames.before * frames.after;
  const Eigen::Isometry3d axis = frames.after.inverse();  // of the joint, in the link's frame
  const Eigen::Quaterniond turn(place.linear());
  std::string text = fmt::format(
      "<body name=\"link{}\" pos=\"{:.17g} {:.17g} {:.17g}\" "
      "quat=\"{:.17g} {:.17g} {:.17g} {:.17g}\">"
      "<inertial pos=\"0.1 0.2 0.3\" quat=\"0.5 0.5 0.5 0.5\" mass=\"1\" diaginertia=\"1 1 1\"/>",
      j + 1, place.translation().x(), place.translation().y(), place.translation().z(), turn.w(),
      turn.x(), turn.y(), turn.z());
  if (joint.sigma != 2) {
    const Eigen::Vector3d point = axis.translation(), z = axis.linear().col(2);
    text += fmt::format(
        "<joint name=\"joint{}\" type=\"{}\" pos=\"{:.17g} {:.17g} {:.17g}\" "
        "axis=\"{:.17g} {:.17g} {:.17g}\" armature=\"{:.17g}\" damping=\"{:.17g}\"/>",
        j + 1, joint.sigma == 0 ? "hinge" : "slide", point.x(), point.y(), point.z(), z.x(), z.y(),
        z.z(), joint.IA, joint.Fv);
  }
  for (std::size_t child = j + 1; child < robot.size(); ++child) {
    if (robot.joints[child].parent == static_cast<int>(j + 1)) text += body_text(robot, child);
  }
  return text + "</body>";
}

std::string model_text(const NumericRobot& robot) {
  const auto& a = robot.base_acceleration;
  std::string text = fmt::format(
      "<mujoco><compiler angle=\"radian\"/><option gravity=\"{:.17g} {:.17g} {:.17g}\"/>"
      "<worldbody>",
      -a[0], -a[1], -a[2]);
  for (std::size_t j = 0; j < robot.size(); ++j) {
    if (robot.joints[j].parent == 0) text += body_text(robot, j);
  }
  return text + "</worldbody></mujoco>";
}

void set_inertia(mjModel& model, int body, const NumericJoint& joint) {
  const CentralInertia link = central_inertia(joint);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(central_tensor(link));
  Eigen::Matrix3d axes = principal.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  const Eigen::Quaterniond turn(axes);
  model.body_mass[body] = link.mass;
  std::copy_n(link.com.begin(), 3, model.body_ipos + 3 * body);
  std::copy_n(principal.eigenvalues().data(), 3, model.body_inertia + 3 * body);
  const std::array<double, 4> quaternion = {turn.w(), turn.x(), turn.y(), turn.z()};
  std::copy_n(quaternion.begin(), 4, model.body_iquat + 4 * body);
}

}  // namespace

mjModel* make_mujoco_model(const NumericRobot& robot) {
  mjModel* const model = mujoco_model_of_text(model_text(robot), "robot.xml").release();
  for (std::size_t j = 0; j < robot.size(); ++j) {
    const int body = mj_name2id(model, mjOBJ_BODY, fmt::format("link{}", j + 1).c_str());
    set_inertia(*model, body, robot.joints[j]);
  }
  return model;
}

}  // namespace dyngen::test
