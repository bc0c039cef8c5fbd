// SPDX-License-Identifier: MIT
#include "runtime/control/control_model.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

namespace dyngen::runtime {

ControlModel control_model(const ModelFunctions& functions) {
  functions.validate();
  ControlModel model;
  model.joints = functions.nq;
  if (functions.gravity != nullptr) model.gravity = functions.gravity;
  if (functions.friction != nullptr) model.friction = functions.friction;
  if (functions.id != nullptr) {
    if (functions.friction == nullptr) {
      throw std::invalid_argument(fmt::format(
          "control_model(): {} has id but no friction, which is subtracted from it; add friction "
          "to FUNCTIONS of dyngen_add_robot",
          functions.name));
    }
    model.rigid = [id = functions.id, friction = functions.friction,
                   loss = std::vector<double>(static_cast<std::size_t>(functions.nq))](
                      const double* q, const double* dq, const double* ddq, double* tau) mutable {
      id(q, dq, ddq, tau);
      friction(dq, loss.data());
      for (std::size_t j = 0; j < loss.size(); ++j) tau[j] -= loss[j];
    };
  }
  return model;
}

}  // namespace dyngen::runtime
