// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/control/controller.h"
#include "runtime/simulation/closed_loop.h"
#include "runtime/tools/dynid/options/loop_settings.h"
#include "runtime/tools/dynid/simulate/simulated_robot.h"

namespace dyngen::runtime {

/// One value for all joints, or one a joint.
/// @param option  named in the message
/// @throws std::invalid_argument  if it is another number of values
Eigen::VectorXd per_joint(const char* option, const std::vector<double>& values, int joints);

/// (n x n) of a plant.
Eigen::MatrixXd mass_matrix_of(const SimulatedRobot& robot, const Eigen::VectorXd& q);

/// Gains of pd, gravity and ff come from the plant's inertia at a posture: they are tuned on the
/// machine, whatever the model says. Torque is not limited.
/// @throws std::invalid_argument  if an inertia there is not positive, or a list is too long
ControllerOptions controller_options(const LoopSettings& settings, const SimulatedRobot& plant,
                                     const Eigen::VectorXd& posture);

/// (n) N m or N: of the plant's file where the drive saturates, else infinite.
Eigen::VectorXd torque_limit_of(const LoopSettings& settings, const SimulatedRobot& plant);

/// The loop without noise, as long as its trajectory.
ClosedLoopOptions loop_options(const LoopSettings& settings, int joints);

}  // namespace dyngen::runtime
