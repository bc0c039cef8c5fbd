// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

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
  /// Of each drive, the coordinate of its link: behind a spring another one than the drive's own.
  /// The drives are the first coordinates, and links behind springs the rest. Empty: rigid joints.
  std::vector<int> links{};
  /// All coordinates where the drives are at q and dq, and springs carry the links without
  /// acceleration. Absent in a robot of rigid joints.
  /// @throws std::runtime_error  if springs cannot carry the links
  std::function<Eigen::VectorXd(const Eigen::VectorXd& q, const Eigen::VectorXd& dq)> at_rest{};
  /// (drives) s, not negative: by which drives follow a command late, as first-order lags; empty:
  /// at once. What commands the plant sees to it (simulate()).
  Eigen::VectorXd lag{};

  /// How many joints have a drive and an encoder: all of a robot of rigid joints.
  [[nodiscard]] int drives() const {
    return links.empty() ? joints : static_cast<int>(links.size());
  }

  /// @throws std::invalid_argument  if a function is missing, coulomb is not n such values, or
  ///         links or lag are not of its drives
  void validate() const;
};

}  // namespace dyngen::runtime
