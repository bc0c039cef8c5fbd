// SPDX-License-Identifier: MIT
// Real robots whose recordings lie in the folder of real recordings, and their rigid bodies by the
// judge of tests/support, which knows neither gen/ nor runtime/.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tests/blind/real/motion_of_table.h"
#include "tests/support/numeric_robot.h"

namespace blind {

struct RealRobot {
  std::string name;
  std::string robot_file;                ///< from the project's folder: what dynid gets
  std::vector<std::string> train, held;  ///< recordings, from the folder of real recordings
  dyngen::test::NumericRobot bodies;     ///< lengths and gravity; no inertia
  double reach = 0.03;                   ///< s, of the smoothing
};

/// "tx40" or "dfki". @throws std::invalid_argument
RealRobot real_robot(const std::string& name);

/// Torque of a unit of each of ten inertial parameters of each link, at some samples:
/// (samples * joints x 10 links), all of joint 1 first.
Eigen::MatrixXd rigid_columns(const RealRobot& robot, const RealMotion& motion);

/// Torque on every joint of a force N, fixed in frame 0, at a point of a link. (joints)
/// @param link  from 0      @param point  m, in the link's frame
Eigen::VectorXd torque_of_force(const RealRobot& robot, const Eigen::VectorXd& q, Eigen::Index link,
                                const Eigen::Vector3d& point, const Eigen::Vector3d& force);

}  // namespace blind
