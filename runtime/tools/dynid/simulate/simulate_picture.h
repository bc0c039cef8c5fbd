// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/plots/figure.h"
#include "runtime/simulation/closed_loop.h"
#include "runtime/tools/dynid/simulate/simulated_robot.h"

namespace dyngen::runtime {

/// What every joint did and was asked for, by how much it missed, and its torque.
/// @param title  of the figure
Figure picture_of(const ClosedLoopRun& run, const SimulatedRobot& robot, const std::string& title);

}  // namespace dyngen::runtime
