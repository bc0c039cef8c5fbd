// SPDX-License-Identifier: MIT
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

namespace dyngen::test {

struct DeleteMujocoModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
using MujocoModel = std::unique_ptr<mjModel, DeleteMujocoModel>;

/// MuJoCo's model of a description that stands in memory.
/// @param name  of the file that the text would be in; its ending says how it is read: .xml, .urdf
/// @throws std::runtime_error  with MuJoCo's message and the text
MujocoModel mujoco_model_of_text(const std::string& text, const std::string& name);

}  // namespace dyngen::test
