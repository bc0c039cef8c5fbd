// SPDX-License-Identifier: MIT
// The controllers that move the machines.
#pragma once

#include "tests/blind/simulation/motion.h"
#include "tests/blind/simulation/plant.h"

namespace blind {

enum class Loop { kPd, kPid, kComputedTorque };

struct LoopOptions {
  Loop kind = Loop::kPd;
  double bandwidth = 25;  ///< rad/s
};

/// Lets a controller that knows another machine, `believed`, move the plant. The integrals of a PID
/// are states of the plant.
/// @param inertia  (j) what the gains are for, kg m^2
/// @param friction (j) dry friction that computed torque believes in, N m
void close_loop(Plant& plant, const LoopOptions& options, const Engine& believed,
                const Eigen::VectorXd& armature, const Eigen::VectorXd& inertia,
                const Eigen::VectorXd& friction, const Motion& motion);

}  // namespace blind
