// SPDX-License-Identifier: MIT
// MuJoCo: of mj_forward and mj_inverse only what a robot without contacts, springs and motors
// needs.
#include <algorithm>
#include <memory>
#include <vector>

#include "tests/bench/peers.h"
#include "tests/peers/mujoco_model.h"

namespace dyngen::bench {
namespace {

struct Mujoco {
  Mujoco(const test::NumericRobot& robot, const States& all)
      : model(test::make_mujoco_model(robot)), data(mj_makeData(model)), states(all) {
    mj_setConst(model, data);
    mj_resetData(model, data);
  }
  ~Mujoco() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  Mujoco(const Mujoco&) = delete;
  Mujoco& operator=(const Mujoco&) = delete;

  void set_position(std::size_t k) const {
    std::copy_n(states.sample(k).q, states.joints, data->qpos);
    mj_kinematics(model, data);
    mj_comPos(model, data);
  }
  void set_velocity(std::size_t k) const {
    std::copy_n(states.sample(k).dq, states.joints, data->qvel);
    mj_comVel(model, data);
  }
  void id(std::size_t k, double* tau) const {
    set_position(k);
    set_velocity(k);
    std::copy_n(states.sample(k).ddq, states.joints, data->qacc);
    mj_rne(model, data, 1, tau);
  }
  void mass_matrix(std::size_t k, double* M) const {
    set_position(k);
    mj_crb(model, data);
    mj_fullM(model, M, data->qM);
  }
  void fd(std::size_t k, double* ddq) const {
    set_position(k);
    mj_crb(model, data);
    mj_factorM(model, data);
    set_velocity(k);
    mj_rne(model, data, 0, data->qfrc_bias);
    const double* const tau = states.sample(k).tau;
    for (std::size_t j = 0; j < states.joints; ++j) {
      data->qfrc_smooth[j] = tau[j] - data->qfrc_bias[j];
    }
    mj_solveM(model, data, ddq, data->qfrc_smooth, 1);
  }

  mjModel* model;
  mjData* data;
  States states;
};

}  // namespace

Peer make_mujoco_peer(const test::NumericRobot& robot, const States& states) {
  const auto mujoco = std::make_shared<Mujoco>(robot, states);
  return {{"id", [mujoco](std::size_t k, double* tau) { mujoco->id(k, tau); }},
          {"mass_matrix", [mujoco](std::size_t k, double* M) { mujoco->mass_matrix(k, M); }},
          {"fd", [mujoco](std::size_t k, double* ddq) { mujoco->fd(k, ddq); }}};
}

}  // namespace dyngen::bench
