// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <array>
#include <cstring>
#include <stdexcept>

#include "tests/peers/description_robots.h"

namespace dyngen::test {
namespace {

class MujocoRobot : public TorqueRobot {
 public:
  MujocoRobot(const std::string& text, const std::string& name) {
    // mjVFS is too large for the stack
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    if (mj_makeEmptyFileVFS(files.get(), name.c_str(), static_cast<int>(text.size())) != 0) {
      throw std::runtime_error("MuJoCo: no room for the model's text");
    }
    std::memcpy(files->filedata[0], text.data(), text.size());
    std::array<char, 500> message{};
    model_.reset(mj_loadXML(name.c_str(), files.get(), message.data(), message.size()));
    mj_deleteVFS(files.get());
    if (!model_) throw std::runtime_error(fmt::format("MuJoCo: {}\n{}", message.data(), text));
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
  struct Delete {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };
  std::unique_ptr<mjModel, Delete> model_;
  std::unique_ptr<mjData, Delete> data_;
};

}  // namespace

std::unique_ptr<TorqueRobot> mujoco_robot(const std::string& text, const std::string& name) {
  return std::make_unique<MujocoRobot>(text, name);
}

}  // namespace dyngen::test
