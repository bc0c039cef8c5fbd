// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

#include "runtime/estimation/rows.h"

/// Equations tau = Y beta + noise with a truth, for tests of estimators.
namespace dyngen::test {

/// Two joints; the first sees all parameters, the second the later half.
struct RandomEquations {
  int parameters = 0;
  std::vector<std::vector<int>> columns;
  Eigen::VectorXd truth;
  Eigen::MatrixXd Y;      ///< (N x 2 nb): smooth in time as motions are
  Eigen::MatrixXd clean;  ///< (N x 2) Y truth

  RandomEquations(int parameters, Eigen::Index samples, std::uint64_t seed);
  /// Autoregressive noise of order one. @param deviation  of each joint
  [[nodiscard]] Eigen::MatrixXd noisy(double pole, const Eigen::Vector2d& deviation,
                                      std::mt19937_64& random) const;
  /// In blocks of this many samples.
  [[nodiscard]] runtime::RowSource source(const Eigen::MatrixXd& tau,
                                          Eigen::Index block = 700) const;
};

}  // namespace dyngen::test
