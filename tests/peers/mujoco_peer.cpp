// SPDX-License-Identifier: MIT
// MuJoCo: bodies in world coordinates, composite inertias and recursive Newton-Euler by itself.
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <memory>

#include "tests/peers/mujoco_model.h"
#include "tests/peers/peer.h"

namespace dyngen::test {
namespace {

struct Mujoco {
  explicit Mujoco(const NumericRobot& robot) : model(make_mujoco_model(robot)) {
    for (std::size_t j = 0; j < robot.size(); ++j) {
      bodies.push_back(mj_name2id(model, mjOBJ_BODY, fmt::format("link{}", j + 1).c_str()));
      if (robot.joints[j].sigma == 2) continue;
      // in a tree MuJoCo's joints stand depth first
      const int joint = mj_name2id(model, mjOBJ_JOINT, fmt::format("joint{}", j + 1).c_str());
      places.push_back(static_cast<std::size_t>(model->jnt_dofadr[joint]));
    }
    data = mj_makeData(model);
    mj_setConst(model, data);
    mj_resetData(model, data);
    std::copy_n(model->opt.gravity, 3, gravity.begin());
  }
  ~Mujoco() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  Mujoco(const Mujoco&) = delete;
  Mujoco& operator=(const Mujoco&) = delete;

  void write(const std::vector<double>& values, double* to) const {
    for (std::size_t i = 0; i < places.size(); ++i) to[places[i]] = values.empty() ? 0 : values[i];
  }
  [[nodiscard]] std::vector<double> read(const double* from) const {
    std::vector<double> result;
    for (const std::size_t place : places) result.push_back(from[place]);
    return result;
  }
  void set(const PeerInput& in) const {
    std::copy(gravity.begin(), gravity.end(), model->opt.gravity);
    write(in.q, data->qpos);
    write(in.dq, data->qvel);
    write(in.ddq, data->qacc);
    write(in.tau, data->qfrc_applied);
    mj_kinematics(model, data);
    mj_comPos(model, data);
    mj_comVel(model, data);
  }
  /// J' w of the wrench on the last link, in MuJoCo's order of joints.
  [[nodiscard]] std::vector<double> wrench_torque(const PeerInput& in) const {
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(data->xmat +
                                                                           9 * bodies.back());
    const Eigen::Vector3d force = R * Eigen::Vector3d(in.wrench.data());
    const Eigen::Vector3d moment = R * Eigen::Vector3d(in.wrench.data() + 3);
    std::vector<double> torque(static_cast<std::size_t>(model->nv), 0.0);
    mj_applyFT(model, data, force.data(), moment.data(), data->xpos + 3 * bodies.back(),
               bodies.back(), torque.data());
    return torque;
  }
  [[nodiscard]] std::vector<double> rne() const {
    std::vector<double> torque(static_cast<std::size_t>(model->nv));
    mj_rne(model, data, 0, torque.data());
    return read(torque.data());
  }
  [[nodiscard]] int body(int link) const {
    return link == 0 ? bodies.back() : bodies[static_cast<std::size_t>(link - 1)];
  }

  mjModel* model;
  mjData* data = nullptr;
  std::vector<int> bodies;
  std::vector<std::size_t> places;  ///< of the robot's coordinates
  std::array<double, 3> gravity{};
};

}  // namespace

Peer make_mujoco_peer(const NumericRobot& robot) {
  const auto mujoco = std::make_shared<Mujoco>(robot);
  Peer peer;
  peer.name = "MuJoCo";
  peer.holds_rotor = peer.holds_viscous = true;
  peer.calls["id"] = [mujoco](const PeerInput& in) {
    mujoco->set(in);
    mj_inverse(mujoco->model, mujoco->data);
    std::vector<double> tau(mujoco->data->qfrc_inverse,
                            mujoco->data->qfrc_inverse + mujoco->model->nv);
    const std::vector<double> of_wrench = mujoco->wrench_torque(in);
    for (std::size_t i = 0; i < tau.size(); ++i) tau[i] -= of_wrench[i];
    return mujoco->read(tau.data());
  };
  peer.calls["gravity"] = [mujoco](const PeerInput& in) {
    mujoco->set({in.q, {}, {}, {}, {}, 0});
    return mujoco->rne();
  };
  peer.calls["coriolis"] = [mujoco](const PeerInput& in) {
    mujoco->set(in);
    std::fill_n(mujoco->model->opt.gravity, 3, 0.0);
    return mujoco->rne();
  };
  peer.calls["mass_matrix"] = [mujoco](const PeerInput& in) {
    mujoco->set(in);
    mj_crb(mujoco->model, mujoco->data);
    const auto n = static_cast<std::size_t>(mujoco->model->nv);
    std::vector<double> M(n * n), result;
    mj_fullM(mujoco->model, M.data(), mujoco->data->qM);
    for (const std::size_t row : mujoco->places) {
      for (const std::size_t column : mujoco->places) result.push_back(M[row * n + column]);
    }
    return result;
  };
  peer.calls["fd"] = [mujoco](const PeerInput& in) {
    mujoco->set(in);
    const std::vector<double> of_wrench = mujoco->wrench_torque(in);
    for (std::size_t i = 0; i < of_wrench.size(); ++i) {
      mujoco->data->qfrc_applied[i] += of_wrench[i];
    }
    mj_forward(mujoco->model, mujoco->data);
    return mujoco->read(mujoco->data->qacc);
  };
  peer.calls["fk"] = [mujoco](const PeerInput& in) {
    mujoco->set(in);
    const double* const R = mujoco->data->xmat + 9 * mujoco->body(in.link);
    const double* const p = mujoco->data->xpos + 3 * mujoco->body(in.link);
    return std::vector<double>{R[0], R[1], R[2], p[0], R[3], R[4], R[5], p[1],
                               R[6], R[7], R[8], p[2], 0,    0,    0,    1};
  };
  peer.calls["jacobian"] = [mujoco](const PeerInput& in) {
    mujoco->set(in);
    const auto n = static_cast<std::size_t>(mujoco->model->nv);
    std::vector<double> J(6 * n), result;
    const int body = mujoco->body(in.link);
    mj_jac(mujoco->model, mujoco->data, J.data(), J.data() + 3 * n, mujoco->data->xpos + 3 * body,
           body);
    for (std::size_t row = 0; row < 6; ++row) {
      for (const std::size_t place : mujoco->places) result.push_back(J[row * n + place]);
    }
    return result;
  };
  return peer;
}

}  // namespace dyngen::test
