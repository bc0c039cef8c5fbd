// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

#include "tests/bench/peers.h"
#include "tests/support/central_inertia.h"

namespace dyngen::bench {
namespace {

/// The tree with its geometry. The inertias are not the robot's yet: MuJoCo's compiler refuses
/// those that no solid body can have, such as the published link 3 of the PUMA 560, and they are
/// set afterwards.
std::string mjcf(const test::NumericRobot& robot) {
  const auto& a = robot.base_acceleration;
  std::string text =
      fmt::format("<mujoco><compiler angle=\"radian\"/><option gravity=\"{} {} {}\"/><worldbody>",
                  -a[0], -a[1], -a[2]);
  for (const test::NumericJoint& joint : robot.joints) {
    using Eigen::AngleAxisd, Eigen::Vector3d;
    const AngleAxisd twist(joint.alpha, Vector3d::UnitX());
    const Vector3d position = Vector3d(joint.d, 0, 0) + twist * Vector3d(0, 0, joint.r);
    const Eigen::Quaterniond turn(twist * AngleAxisd(joint.theta, Vector3d::UnitZ()));
    text += fmt::format(
        "<body pos=\"{:.17g} {:.17g} {:.17g}\" quat=\"{:.17g} {:.17g} {:.17g} {:.17g}\">"
        "<joint type=\"hinge\" axis=\"0 0 1\"/>"
        "<inertial pos=\"0.1 0.2 0.3\" quat=\"0.5 0.5 0.5 0.5\" mass=\"1\" diaginertia=\"1 1 1\"/>",
        position.x(), position.y(), position.z(), turn.w(), turn.x(), turn.y(), turn.z());
  }
  for (std::size_t j = 0; j < robot.size(); ++j) text += "</body>";
  return text + "</worldbody></mujoco>";
}

void set_inertia(mjModel& model, int body, const test::NumericJoint& joint) {
  const test::CentralInertia link = test::central_inertia(joint);
  Eigen::Matrix3d tensor;
  tensor << link.xx, link.xy, link.xz, link.xy, link.yy, link.yz, link.xz, link.yz, link.zz;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(tensor);
  Eigen::Matrix3d axes = principal.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  const Eigen::Quaterniond turn(axes);
  model.body_mass[body] = link.mass;
  std::copy_n(link.com.begin(), 3, model.body_ipos + 3 * body);
  std::copy_n(principal.eigenvalues().data(), 3, model.body_inertia + 3 * body);
  const std::array<double, 4> quaternion = {turn.w(), turn.x(), turn.y(), turn.z()};
  std::copy_n(quaternion.begin(), 4, model.body_iquat + 4 * body);
}

mjModel* make_model(const test::NumericRobot& robot) {
  const std::string text = mjcf(robot);
  const std::string name = "robot.xml";
  mjVFS files;
  mj_defaultVFS(&files);
  if (mj_makeEmptyFileVFS(&files, name.c_str(), static_cast<int>(text.size())) != 0) {
    throw std::runtime_error("MuJoCo: no room for the model's text");
  }
  std::memcpy(files.filedata[0], text.data(), text.size());
  std::array<char, 500> message{};
  mjModel* model = mj_loadXML(name.c_str(), &files, message.data(), message.size());
  mj_deleteVFS(&files);
  if (model == nullptr) throw std::runtime_error(std::string("MuJoCo: ") + message.data());
  for (std::size_t j = 0; j < robot.size(); ++j) {
    set_inertia(*model, static_cast<int>(j) + 1, robot.joints[j]);
  }
  return model;
}

struct Mujoco {
  Mujoco(const test::NumericRobot& robot, const States& all)
      : model(make_model(robot)), data(mj_makeData(model)), states(all) {
    mj_setConst(model, data);
    mj_resetData(model, data);
  }
  ~Mujoco() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  Mujoco(const Mujoco&) = delete;
  Mujoco& operator=(const Mujoco&) = delete;

  void set(std::size_t k) const {
    const std::size_t n = states.joints;
    std::copy_n(states.q.data() + k * n, n, data->qpos);
    std::copy_n(states.dq.data() + k * n, n, data->qvel);
  }
  void place() const {
    mj_kinematics(model, data);
    mj_comPos(model, data);
  }
  /// What mj_inverse() does for a robot without contacts, springs and motors, and no more.
  void id(std::size_t k, double* tau) const {
    set(k);
    std::copy_n(states.ddq.data() + states.at(k), states.joints, data->qacc);
    place();
    mj_comVel(model, data);
    mj_rne(model, data, 1, tau);
  }
  void mass_matrix(std::size_t k, double* M) const {
    set(k);
    place();
    mj_crb(model, data);
    mj_fullM(model, M, data->qM);
  }
  /// What mj_forward() does for such a robot.
  void fd(std::size_t k, double* ddq) const {
    set(k);
    place();
    mj_crb(model, data);
    mj_factorM(model, data);
    mj_comVel(model, data);
    mj_rne(model, data, 0, data->qfrc_bias);
    for (std::size_t j = 0; j < states.joints; ++j) {
      ddq[j] = states.tau[states.at(k) + j] - data->qfrc_bias[j];
    }
    mj_solveM(model, data, ddq, ddq, 1);
  }

  mjModel* model;
  mjData* data;
  States states;
};

}  // namespace

Peer make_mujoco_peer(const test::NumericRobot& robot, const States& states) {
  const auto mujoco = std::make_shared<Mujoco>(robot, states);
  Peer peer{.name = "MuJoCo", .calls = {}};
  peer.calls["id"] = [mujoco](std::size_t k, double* out) { mujoco->id(k, out); };
  peer.calls["mass_matrix"] = [mujoco](std::size_t k, double* out) { mujoco->mass_matrix(k, out); };
  peer.calls["fd"] = [mujoco](std::size_t k, double* out) { mujoco->fd(k, out); };
  return peer;
}

}  // namespace dyngen::bench
