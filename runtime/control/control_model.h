// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "runtime/model/model_functions.h"

namespace dyngen::runtime {

/// The functions of a robot that control laws are made of: the door to generated C, to a program
/// that is evaluated without a compiler, or to a user's own model.
///
/// Pointers are to `joints` values each. A controller calls the functions in its control loop: they
/// must not throw, allocate or wait. A function that is empty is one the model does not have.
struct ControlModel {
  int joints = 0;
  /// tau = M(q) ddq + c(q, dq) + g(q), N m or N: inverse dynamics without friction and offset
  std::function<void(const double* q, const double* dq, const double* ddq, double* tau)> rigid;
  /// tau = g(q)
  std::function<void(const double* q, double* tau)> gravity;
  /// tau = friction and constant offset; that of a joint depends on its own dq alone
  std::function<void(const double* dq, double* tau)> friction;
};

/// The door filled with generated C. `rigid` is id - friction, so both must have been generated for
/// it; each copy of it has a buffer of its own and belongs to one thread.
/// @throws std::invalid_argument  of ModelFunctions::validate(), or if there is id but no friction
ControlModel control_model(const ModelFunctions& functions);

}  // namespace dyngen::runtime
