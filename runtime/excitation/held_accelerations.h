// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

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
