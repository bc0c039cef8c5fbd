// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "gen/model/robot_model.h"
#include "tests/support/model_bridge.h"
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

/// Wrench on the last link's frame (force, moment about its origin, in it): its virtual work per
/// unit of each joint's coordinate, J' w. One entry per joint.
std::vector<long double> wrench_torque(const NumericRobot& robot, const std::vector<long double>& q,
                                       const std::array<double, 6>& wrench);

/// n x n matrices over the coordinates, row-major: d tau_i / d x_j.
struct TorqueDerivatives {
  std::vector<long double> position, velocity, acceleration;
};

/// Of id, a wrench on the last link taken off (empty: none), by differences of fourth order of the
/// judge's torques in long double.
///
/// Steps of 1e-3 for positions: truncation h^4 / 30 times the fifth derivative, 1e-13 of the torque
/// or less for chains whose angles add up to three; rounding 1e-19 / h. Torques are polynomials of
/// degree 2 in velocities, without Coulomb friction, and of degree 1 in accelerations: steps of 1/8
/// make no error.
TorqueDerivatives torque_derivatives(const RobotModel& model, NumericRobot robot,
                                     const MotionSample& sample);

}  // namespace dyngen::test
