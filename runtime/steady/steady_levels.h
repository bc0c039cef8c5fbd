// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "runtime/recordings/recording.h"
#include "runtime/rules/steady_rules.h"
#include "runtime/steady/mean_noise.h"
#include "runtime/steady/steady_runs.h"

namespace dyngen::runtime {

/// Recordings of a joint in which runs are looked for.
struct SteadyInput {
  std::vector<std::shared_ptr<const Recording>> recordings;
  Eigen::Index joint = 0;  ///< from 0
  bool revolute = true;
  /// (count) torque of everything but the joint's own friction, of the fitted model; empty: runs in
  /// which other joints move are left out
  std::function<Eigen::VectorXd(const Stretch&)> rest;
};

/// The mean torque of a run.
struct SteadyLevel {
  SteadyRun run;
  double torque = 0;  ///< N m or N, less what gravity differs from its mean in the posture
  int posture = 0;    ///< of the others, from 0: each has a constant torque of its own
};

/// The levels of a joint: one observation each, with the variance that slow noise gives a mean.
struct SteadyLevels {
  std::vector<SteadyLevel> levels;
  Eigen::MatrixXd covariance;  ///< (R x R)
  int degrees = 1;             ///< by which the covariance is known
  int postures = 0;
  int left_out = 0;  ///< runs in which other joints move and whose rest is not known
  double seconds = 0;
};

/// Where other joints stand, gravity about an axis that turns is a cos q + b sin q. Both numbers
/// come from the slopes within the runs, and no model is needed.
SteadyLevels steady_levels(const SteadyInput& input, const SteadyRules& rules);

}  // namespace dyngen::runtime
