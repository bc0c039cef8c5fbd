// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "gen/model/robot_model.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_robot.h"

/// What the judge says of whole robots, by central differences in long double.
namespace dyngen::test {

/// Coriolis matrix of the Christoffel symbols over the coordinates, row-major: from differences of
/// the judge's mass matrix. Steps of 1e-4 of fourth order: truncation and rounding some 1e-15 of
/// it.
std::vector<long double> christoffel_matrix(const RobotModel& model, const NumericRobot& robot,
                                            const MotionSample& sample);

/// dM/dt along dq, the same way.
std::vector<long double> mass_matrix_rate(const RobotModel& model, const NumericRobot& robot,
                                          const MotionSample& sample);

/// J' w, N m or N, over the coordinates: w[6] N, N m acts on a link (from 0), about its origin, in
/// the axes of frame 0.
std::vector<long double> torque_of_wrench(const RobotModel& model, const NumericRobot& robot,
                                          const std::vector<double>& q, std::size_t link,
                                          const std::vector<long double>& wrench);

struct NumericCentroid {
  long double mass = 0;                   ///< kg
  std::array<long double, 3> center{};    ///< m, in frame 0
  std::vector<long double> jacobian;      ///< 3 x coordinates, row-major
  std::array<long double, 6> momentum{};  ///< linear, angular about the origin of frame 0
};

/// From poses of the links and their differences, link by link.
NumericCentroid numeric_centroid(const RobotModel& model, const NumericRobot& robot,
                                 const MotionSample& sample);

}  // namespace dyngen::test
