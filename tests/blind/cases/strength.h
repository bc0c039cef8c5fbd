// SPDX-License-Identifier: MIT
// How much of what was left out the recordings still show when all base parameters are refitted:
// the currency of the suite. By the truth's own numbers, with the engine's own regressor.
#pragma once

#include <vector>

#include "tests/blind/simulation/machine.h"
#include "tests/blind/simulation/noise.h"

namespace blind {

/// A recording, and what was added to it.
struct Recording {
  Log log;
  Eigen::MatrixXd torque_noise;   ///< (N x j) N m
  Eigen::MatrixXd encoder_error;  ///< (N x j) rad
};

/// Torque per base parameter, (N j x 14 n): ten inertial ones a link as point masses, then
/// armature, dry and viscous friction, offset. Rows: all samples of joint 1, then of joint 2, ...
/// The dry friction of a joint that rests is the one that holds it.
Eigen::MatrixXd base_columns(const Machine& machine, const Log& log);

/// What the true base parameters give on the recorded motion, (N j): the rest of `recorded` is
/// what is left out.
Eigen::VectorXd base_torque(const Machine& machine, const Log& log);

/// Makes the equations 0 = 0 where a joint rests: friction holds it with any torque there.
/// @param rows  (N j x k), in place
void leave_out_rest(const Log& log, Eigen::Ref<Eigen::MatrixXd> rows);

/// (N x j) in the order of those rows.
Eigen::VectorXd torque_rows(const Eigen::MatrixXd& by_joint);

/// Makes the noise of the equations white, of variance 1: torque noise, and what encoders add
/// through the accelerations. Spectra of all training recordings, smoothed over near lines.
class Whitener {
 public:
  explicit Whitener(const std::vector<Recording>& training);
  /// @param rows  (N j x k) of one recording
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& rows) const;
  /// One joint's column, (N).
  Eigen::VectorXd column(Eigen::Index joint, const Eigen::VectorXd& values) const;

 private:
  Eigen::MatrixXd deviation_;  // (lines x j) root of the spectrum, from 0 to half of the rate
};

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
