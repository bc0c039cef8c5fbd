// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runtime/excitation/criterion.h"
#include "runtime/excitation/information.h"
#include "runtime/excitation/limited_trajectory.h"
#include "runtime/excitation/motion_limits.h"
#include "runtime/excitation/trajectory_basis.h"

namespace dyngen::runtime {

/// How a trajectory is looked for.
struct ExcitationOptions {
  TrajectoryFamily family;
  CriterionOptions criterion;
  InformationOptions information;
  int starts = 3;             ///< random trajectories to begin from
  std::uint64_t seed = 1;     ///< of the first of them; the others' follow
  double seconds = 60;        ///< at most
  int evaluations = 0;        ///< at most, of all starts; above 0 the clock ends nothing
  double check_rate = 10000;  ///< Hz, at which limits must be kept
  /// Told now and then what is being done.
  std::function<void(const std::string& what, std::size_t place, std::size_t all)> progress;

  /// @throws std::invalid_argument  naming what was found and what was expected
  void validate() const;
};

/// A start and what became of it.
struct ExcitationStart {
  std::uint64_t seed = 0;
  double random = 0;     ///< condition number of the random trajectory, which keeps the limits
  double optimised = 0;  ///< and of what was first made of it
};

struct Excitation {
  bool found = false;  ///< false: no trajectory keeps the limits; see message
  std::string message;
  Eigen::MatrixXd x;       ///< (m x n) parameters of the family
  Eigen::MatrixXd random;  ///< (m x n) of the first start
  LimitShares shares;      ///< of x at the check rate
  std::vector<ExcitationStart> starts;
  int evaluations = 0;
};

/// Looks for the trajectory of a family whose recording says most of the parameters, within limits.
///
/// From each random start the criterion is minimised with gradients through the regressor, with
/// soft edges first and sharp ones later; the best goes on. The result is checked at the check rate
/// and, where a limit is passed between the instants of the optimisation, optimised again with
/// tighter limits until it is kept.
/// @throws std::invalid_argument  if options or limits do not fit the model
Excitation excite(const LinearModel& model, const MotionLimits& limits,
                  const ExcitationOptions& options);

}  // namespace dyngen::runtime
