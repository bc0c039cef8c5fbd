// SPDX-License-Identifier: MIT
// How much of what was left out the recordings still show when all base parameters are refitted:
// the currency of the suite. By the truth's own numbers, with the engine's own regressor.
#pragma once

#include <vector>

#include "tests/blind/cases/whitening.h"
#include "tests/blind/simulation/machine.h"

namespace blind {

/// Torque per base parameter, (N j x 14 n): ten inertial ones a link as point masses, then
/// armature, dry and viscous friction, offset. Rows: all samples of joint 1, then of joint 2, ...
/// The dry friction of a joint that rests is the one that holds it.
Eigen::MatrixXd base_columns(const Machine& machine, const Log& log);

/// What the true base parameters give on the recorded motion, (N j): the rest of `recorded` is
/// what is left out.
Eigen::VectorXd base_torque(const Machine& machine, const Log& log);

/// (N x j) in the order of those rows.
Eigen::VectorXd torque_rows(const Eigen::MatrixXd& by_joint);

/// Least squares on whitened columns of all training recordings.
class Refit {
 public:
  explicit Refit(std::vector<Eigen::MatrixXd> whitened);
  /// @param rows  whitened (N j) of each recording
  Eigen::VectorXd solve(const std::vector<Eigen::VectorXd>& rows) const;
  /// What is left of them.
  std::vector<Eigen::VectorXd> residual(const std::vector<Eigen::VectorXd>& rows) const;

 private:
  std::vector<Eigen::MatrixXd> columns_;
  Eigen::VectorXd scale_;
  Eigen::MatrixXd inverse_;  // of the scaled Gram matrix, on its range
};

double squares(const std::vector<Eigen::VectorXd>& rows);

}  // namespace blind
