// SPDX-License-Identifier: MIT
#include <mujoco/mujoco.h>

#include <memory>
#include <string>

#include "tests/peers/description_robots.h"
#include "tests/support/mujoco_text.h"

namespace dyngen::test {
namespace {

class MujocoRobot : public TorqueRobot {
 public:
  MujocoRobot(const std::string& text, const std::string& name)
      : model_(mujoco_model_of_text(text, name)) {
    if (name.ends_with(".urdf")) model_->opt.gravity[2] = -9.81;
    model_->opt.disableflags |= mjDSBL_CONSTRAINT | mjDSBL_CONTACT;
    data_.reset(mj_makeData(model_.get()));
  }

  [[nodiscard]] ByJoint torque(const ByJoint& q, const ByJoint& dq,
                               const ByJoint& ddq) const override {
    for (int j = 0; j < model_->njnt; ++j) {
      const std::string name = mj_id2name(model_.get(), mjOBJ_JOINT, j);
      data_->qpos[model_->jnt_qposadr[j]] = q.at(name);
      data_->qvel[model_->jnt_dofadr[j]] = dq.at(name);
      data_->qacc[model_->jnt_dofadr[j]] = ddq.at(name);
    }
    mj_inverse(model_.get(), data_.get());
    ByJoint result;
    for (int j = 0; j < model_->njnt; ++j) {
      result[mj_id2name(model_.get(), mjOBJ_JOINT, j)] = data_->qfrc_inverse[model_->jnt_dofadr[j]];
    }
    return result;
  }

 private:
  struct DeleteData {
    void operator()(mjData* data) const { mj_deleteData(data); }
  };
  MujocoModel model_;
  std::unique_ptr<mjData, DeleteData> data_;
};

}  // namespace

std::unique_ptr<TorqueRobot> mujoco_robot(const std::string& text, const std::string& name) {
  return std::make_unique<MujocoRobot>(text, name);
}

}  // namespace dyngen::test
