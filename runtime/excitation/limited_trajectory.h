// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include "runtime/excitation/motion_limits.h"
#include "runtime/excitation/trajectory_basis.h"

namespace dyngen::runtime {

/// Times of one period at which limits and information are looked at while a trajectory is sought:
/// 40 for each period of the highest harmonic, so that a peak between two is 0.3 % higher.
Eigen::VectorXd sought_times(const TrajectoryFamily& family);

/// What each parameter alone may be within the limits: the unit in which it is varied. (m x n)
Eigen::MatrixXd parameter_units(const TrajectoryBasis& basis, const MotionLimits& limits);

/// The same mean, less amplitude. @param x  (m x n)
Eigen::MatrixXd shrunk(Eigen::MatrixXd x, double factor);

/// A random trajectory of the family that uses as much of the limits as one of them lets it.
/// @return (m x n); nothing (0 x 0) if a hundred random ones do not keep torque limits and box even
/// when they are small
Eigen::MatrixXd random_trajectory(const LinearModel& model, const MotionLimits& limits,
                                  const TrajectoryFamily& family, std::uint64_t seed);

/// The largest use of every limit over a motion, first and last instant included.
/// @param duration  s        @param motion  at given times, s        @param rate  Hz, of the
/// instants
LimitShares shares_at_rate(const LinearModel& model, const MotionLimits& limits, double duration,
                           const std::function<JointMotion(const Eigen::VectorXd& time)>& motion,
                           double rate);

}  // namespace dyngen::runtime
