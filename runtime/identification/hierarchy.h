// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/identification/summary.h"
#include "runtime/model/linear_model.h"

namespace dyngen::runtime {

/// What robots of one type have in common, and what each has for itself.
struct HierarchyFit {
  std::vector<int> shared;  ///< places of parameters that all robots share, ascending
  std::vector<int> own;     ///< of those that each robot has for itself
  Eigen::VectorXd shared_beta, shared_stddev;
  struct Robot {
    std::string name;
    Eigen::VectorXd own_beta, own_stddev;
    Eigen::VectorXd percent;  ///< (n) residual norm over torque norm

    /// All parameters of this robot, in the model's order.
    [[nodiscard]] Eigen::VectorXd beta(const HierarchyFit& fit) const;
  };
  std::vector<Robot> robots;
  int rank = 0;  ///< of the shared parameters
};

/// Shared inertia, own friction: viscous, Coulomb and offset of each robot are its own.
///
/// Each robot's own parameters are eliminated from its triangular factor first, so the work grows
/// with the number of robots and not with its cube.
/// @param joint_weights  (n) 1/sigma; empty: of the weighted fit to all robots as one
/// @throws std::invalid_argument  if there is no robot, or the model has no friction or nothing
/// else
HierarchyFit fit_own_friction(const LinearModel& model, const RobotSummaries& all,
                              Eigen::VectorXd joint_weights = {});

}  // namespace dyngen::runtime
