// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>

#include "runtime/simulation/plant_effects.h"

namespace dyngen::runtime {

/// The functions of the robot that is simulated. Pointers are to `joints` values each, M to its
/// square, row by row. May keep buffers: one thread at a time.
struct PlantModel {
  int joints = 0;
  /// ddq = M(q)^-1 (tau - c - g - friction(dq)), with sign(0) = 0 in friction
  std::function<void(const double* q, const double* dq, const double* tau, double* ddq)> forward;
  /// tau = M(q) ddq + c(q, dq) + g(q)
  std::function<void(const double* q, const double* dq, const double* ddq, double* tau)> rigid;
  std::function<void(const double* q, double* M)> mass_matrix;
  /// tau = coulomb * sign(dq) + what is smooth in dq
  std::function<void(const double* dq, double* tau)> friction;
  /// (n) Fs, N m or N, not negative: what a joint that stands can resist
  Eigen::VectorXd coulomb;
  /// Effects that act while it moves; friction() and forward() are without them.
  PlantEffects effects{};

  /// @throws std::invalid_argument  if a function is missing or coulomb is not n such values
  void validate() const;
};

}  // namespace dyngen::runtime
