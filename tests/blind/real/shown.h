// SPDX-License-Identifier: MIT
// How much of an added torque a refit of all base parameters leaves, against what the model leaves
// of the recording as it is: noise and all physics that no one has named. A strength in the units
// of lambda, and less than it: who names that other physics sees more.
#pragma once

#include <optional>
#include <vector>

#include "tests/blind/real/real_robot.h"

namespace blind {

/// The fitted recordings of a robot, at 50 samples a second.
class Shown {
 public:
  /// @param motions  of the recordings as they are
  Shown(const RealRobot& robot, const std::vector<RealMotion>& motions);

  /// Squares of what is left of a torque, whitened. @param added  (N x joints) of each recording
  [[nodiscard]] double squares(const std::vector<Eigen::MatrixXd>& added) const;
  /// Share of its squares that the refit takes.
  [[nodiscard]] double absorbed(const std::vector<Eigen::MatrixXd>& added) const;

  /// Torque of the fitted links alone at every sample, (N x joints): no friction, no rotors.
  [[nodiscard]] Eigen::MatrixXd load(const RealMotion& motion) const;
  /// (joints) fitted dry friction, N m; a hundredth of the largest torque where the fit has none.
  [[nodiscard]] const Eigen::VectorXd& dry() const { return dry_; }

 private:
  /// One recording's rows, whitened; rows in which a joint stands are 0.
  [[nodiscard]] Eigen::MatrixXd whitened(std::size_t recording, Eigen::MatrixXd rows) const;
  [[nodiscard]] Eigen::VectorXd stacked(const std::vector<Eigen::MatrixXd>& added) const;

  RealRobot robot_;
  std::vector<Eigen::VectorXd> full_times_;  // of all samples
  std::vector<Eigen::VectorXd> times_;       // of the thinned samples
  std::vector<Eigen::MatrixXd> counted_;     // (samples x joints) 1 or 0
  Eigen::VectorXd rigid_;                    // fitted, of the links; one of many that do the same
  std::vector<Eigen::VectorXd> memory_;      // of each joint's noise: an autoregressive process
  Eigen::VectorXd innovation_;               // N m, its deviation
  Eigen::MatrixXd basis_;                    // orthonormal, of the whitened base columns
  Eigen::VectorXd dry_;
};

}  // namespace blind
