// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/excitation/held_accelerations.h"

namespace dyngen::runtime {

struct MultistageOptions {
  std::vector<int> parameters{};  ///< of the model, ascending; empty: all
  int iterations = 15;
  /// Of the first step, rad/s^2 or m/s^2: the largest change of an acceleration.
  double first_change = 0.1;
  /// u'Qu over all samples at the limits of acceleration, in parts of 1/sigma at the start.
  double acceleration_share = 0.01;
  /// Weight of -log(-c) of every limit's constraint c, in parts of 1/sigma at the start: steps turn
  /// away from limits before they are touched. 0 is the thesis's algorithm.
  double barrier_share = 1e-3;
  /// 1/sigma is replaced by (trace R^-p)^(1/p), which has derivatives where the smallest singular
  /// values meet and is above it by the factor size^(1/p) at most. Infinite is the thesis's.
  double power = 16;
  double seconds = 1e9;  ///< at most; what ends by the clock is not repeated exactly
};

struct MultistageResult {
  HeldAccelerations trajectory{};
  std::vector<double> cost;  ///< 1 / smallest singular value of R: of the start, of every iteration
  std::vector<double> total;  ///< what is minimised: with accelerations and barrier
  LimitShares shares{};       ///< at the samples
  std::string ended;          ///< a sentence: why
};

/// Gradient descent on the accelerations for J = 1 / sigma_min(R) + sum_k u_k' Q u_k, R the mean of
/// Y'Y over the samples, with the gradient by one adjoint sweep through the double integrator.
///
/// Q by Bryson's rule, 1 / (largest acceleration)^2. A step that does not lower J, or leaves the
/// limits, is halved; one that does, makes the next half as large again. It ends after the
/// iterations, or where no step lowers J within the limits.
/// Source: thesis (1995), section 5.3, after Armstrong (1989), "On finding exciting trajectories
/// for identification experiments involving systems with nonlinear dynamics", and Bryson and Ho,
/// "Applied optimal control" (1975); docs/howto/excitation.md lists what is corrected.
/// @throws std::invalid_argument  if the start does not keep the limits, or sizes do not fit
MultistageResult multistage(const LinearModel& model, const MotionLimits& limits,
                            const HeldAccelerations& start, const MultistageOptions& options);

}  // namespace dyngen::runtime
