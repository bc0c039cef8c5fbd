// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "gen/model/robot_model.h"
#include "tests/support/numeric_robot.h"

/// Derivatives of what the judge says, by central differences in long double.
namespace dyngen::test {

/// One value per joint from one per coordinate, as the judge wants them: 0 for a fixed joint.
std::vector<long double> joint_values(const RobotModel& model, const std::vector<double>& values);

/// Velocity of the origin of a link's frame and its angular velocity, in frame 0, when one joint
/// moves at rate 1. Joint and link count from 0.
///
/// Differences of fourth order with steps of 1e-4: truncation some 1e-17 of a metre, rounding
/// 1e-19 / 1e-4.
std::array<long double, 6> joint_screw(const NumericRobot& robot, const std::vector<long double>& q,
                                       std::size_t joint, std::size_t link);

}  // namespace dyngen::test
