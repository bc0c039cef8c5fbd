// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/estimation/instruments.h"
#include "runtime/identification/motion_rows.h"
#include "runtime/identification/motion_source.h"
#include "runtime/model/linear_model.h"
#include "runtime/recordings/trajectory_file.h"

namespace dyngen::runtime {

/// The loop that is assumed around a simulated robot: tau = id(reference) + Kp e + Kd de, with
/// Kp = M_jj (2 pi f)^2 and Kd = 2 M_jj (2 pi f) of each joint.
struct TrackingLoop {
  double frequency = 5;  ///< Hz, f
};

/// What the model does when it tracks a reference: forward dynamics from its own regressor,
/// Runge-Kutta of fourth order at the reference's sample time. Nothing that was measured is in it.
///
/// @param beta       (nb); the mass matrix that it gives must be positive definite on the way
/// @param reference  positions, velocities and accelerations that are commanded
/// @throws std::invalid_argument  if the loop's frequency is not positive or too fast for the
/// sample time; std::runtime_error if the mass matrix is not positive definite somewhere
Motion simulate_tracking(const LinearModel& model, const Eigen::VectorXd& beta,
                         const Motion& reference, const TrackingLoop& loop = {});

/// Equations of a recording with instruments: the regressor of the simulated motion, through the
/// same filter, at the same samples.
/// @param commanded  the motion that the robot was told to make, of the same samples
/// @throws std::invalid_argument  if the two have other runs or samples
InstrumentSource simulated_instruments(const LinearModel& model, const MotionSource& recorded,
                                       const MotionSource& commanded, const RowOptions& options,
                                       const Eigen::VectorXd& beta, const TrackingLoop& loop = {});

/// What was commanded, at the samples of a recording of it: the trajectory between its samples.
/// @param name  of the trajectory, for messages
/// @throws std::invalid_argument  if its joints are others, or its time does not cover the
/// recording
MotionSource commanded_motion(const Trajectory& trajectory, const std::string& name,
                              const MotionSource& recorded);

}  // namespace dyngen::runtime
