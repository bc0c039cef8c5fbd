// SPDX-License-Identifier: MIT
#include "runtime/model/model_functions.h"

#include <fmt/format.h>

#include <stdexcept>

namespace dyngen::runtime {
namespace {

void check_size(const ModelFunctions& model, const char* function, const char* argument,
                const Eigen::VectorXd& vector) {
  if (vector.size() != model.nq) {
    throw std::invalid_argument(fmt::format("{}(): {} has {} values, {} has {} joints", function,
                                            argument, vector.size(), model.name, model.nq));
  }
}

void check_generated(const ModelFunctions& model, const char* function, bool generated) {
  if (!generated) {
    throw std::invalid_argument(
        fmt::format("{}(): {} was generated without this function; add it to "
                    "FUNCTIONS of dyngen_add_robot",
                    function, model.name));
  }
}

}  // namespace

void ModelFunctions::validate() const {
  if (nq < 1) {
    throw std::invalid_argument(
        fmt::format("ModelFunctions: {} has nq = {}, expected 1 or more", name, nq));
  }
  if (joint_names.size() != static_cast<std::size_t>(nq)) {
    throw std::invalid_argument(fmt::format("ModelFunctions: {} has {} joint names, nq = {}", name,
                                            joint_names.size(), nq));
  }
  if (id == nullptr && gravity == nullptr && coriolis == nullptr && friction == nullptr) {
    throw std::invalid_argument(fmt::format("ModelFunctions: {} has no function", name));
  }
}

Eigen::VectorXd inverse_dynamics(const ModelFunctions& model, const Eigen::VectorXd& q,
                                 const Eigen::VectorXd& dq, const Eigen::VectorXd& ddq) {
  check_generated(model, "id", model.id != nullptr);
  check_size(model, "inverse_dynamics", "q", q);
  check_size(model, "inverse_dynamics", "dq", dq);
  check_size(model, "inverse_dynamics", "ddq", ddq);
  Eigen::VectorXd tau(model.nq);
  model.id(q.data(), dq.data(), ddq.data(), tau.data());
  return tau;
}

Eigen::VectorXd gravity(const ModelFunctions& model, const Eigen::VectorXd& q) {
  check_generated(model, "gravity", model.gravity != nullptr);
  check_size(model, "gravity", "q", q);
  Eigen::VectorXd tau(model.nq);
  model.gravity(q.data(), tau.data());
  return tau;
}

Eigen::VectorXd coriolis(const ModelFunctions& model, const Eigen::VectorXd& q,
                         const Eigen::VectorXd& dq) {
  check_generated(model, "coriolis", model.coriolis != nullptr);
  check_size(model, "coriolis", "q", q);
  check_size(model, "coriolis", "dq", dq);
  Eigen::VectorXd tau(model.nq);
  model.coriolis(q.data(), dq.data(), tau.data());
  return tau;
}

Eigen::VectorXd friction(const ModelFunctions& model, const Eigen::VectorXd& dq) {
  check_generated(model, "friction", model.friction != nullptr);
  check_size(model, "friction", "dq", dq);
  Eigen::VectorXd tau(model.nq);
  model.friction(dq.data(), tau.data());
  return tau;
}

}  // namespace dyngen::runtime
