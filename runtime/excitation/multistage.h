// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/excitation/motion_limits.h"
#include "runtime/model/linear_model.h"

namespace dyngen::runtime {

/// A motion by its accelerations, each held for one sample: the double integrator
/// x_{k+1} = A x_k + B u_k with x = (q, dq), A = [I, T; 0, I], B = [T^2 / 2; T].
struct HeldAccelerations {
  double sample_time = 0.005;  ///< s
  Eigen::VectorXd start{};     ///< (n) q at rest
  Eigen::MatrixXd u{};         ///< (K x n)

  /// q, dq and u at the samples, (K x n) each.
  [[nodiscard]] JointMotion motion() const;
};

/// How a motion through chosen points is made.
struct ChosenPointsOptions {
  int samples = 600;
  double sample_time = 0.005;  ///< s
  int points = 6;              ///< that are aimed at, one after the other
  double bandwidth_hz = 0.6;   ///< of the critically damped way to a point, and of the filter
  double share = 0.5;          ///< of the ranges in which points are chosen
  int candidates = 30;         ///< sets of points of which the best is taken
  std::uint64_t seed = 1;
};

/// A motion from rest through chosen points, x_{k+1} = A x_k + B K (x_i - x_k), low-pass filtered.
///
/// Points are random within the limits; of several sets that is taken in which the smallest
/// |R e_m| over the parameters m is largest, since the smallest singular value of R is no larger.
/// Then the motion is made smaller until it keeps its limits.
/// Source: thesis "Dynamic estimation for serial manipulators" (1995), section 5.3.
/// @throws std::invalid_argument  if an option is out of range
HeldAccelerations through_chosen_points(const LinearModel& model, const MotionLimits& limits,
                                        const std::vector<int>& parameters,
                                        const ChosenPointsOptions& options);

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
/// "Applied optimal control" (1975); docs/excitation.md lists what is corrected.
/// @throws std::invalid_argument  if the start does not keep the limits, or sizes do not fit
MultistageResult multistage(const LinearModel& model, const MotionLimits& limits,
                            const HeldAccelerations& start, const MultistageOptions& options);

/// The trajectory with a last part in which every joint is braked evenly, in 0.1 s, 0.2 s ... 3 s:
/// the shortest one that keeps the limits. Where none does, braking begins earlier, at half of the
/// trajectory at the earliest; nothing if that does not help either.
std::optional<HeldAccelerations> brought_to_rest(const LinearModel& model,
                                                 const MotionLimits& limits,
                                                 const HeldAccelerations& trajectory);

/// The same motion in `parts` samples for each of its own.
HeldAccelerations resampled(const HeldAccelerations& trajectory, int parts);

/// dF/du of a function of the motion whose partial derivatives by q, dq and u are given, (K x n):
/// the adjoint lambda_k = A' lambda_{k+1} + dF/dx_k swept from the last sample to the first.
Eigen::MatrixXd adjoint_sweep(const JointMotion& partial, double sample_time);

}  // namespace dyngen::runtime
