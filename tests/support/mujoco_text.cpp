// SPDX-License-Identifier: MIT
#include "tests/support/mujoco_text.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <stdexcept>

namespace dyngen::test {

MujocoModel mujoco_model_of_text(const std::string& text, const std::string& name) {
  // mjVFS is too large for the stack
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  if (mj_makeEmptyFileVFS(files.get(), name.c_str(), static_cast<int>(text.size())) != 0) {
    throw std::runtime_error("MuJoCo: no room for the model's text");
  }
  std::memcpy(files->filedata[0], text.data(), text.size());
  std::array<char, 500> message{};
  MujocoModel model(mj_loadXML(name.c_str(), files.get(), message.data(), message.size()));
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error(fmt::format("MuJoCo: {}\n{}", message.data(), text));
  return model;
}

}  // namespace dyngen::test
