// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>

#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// The numbers of a robot file as parameters of a model made of it: an absent row is 0.
///
/// @param robot  of the same source, whatever it leaves open
/// @param why    what numbers are needed for, the end of the message: "since ..."
/// @return       (nb)
/// @throws ModelError  naming what is unknown
Eigen::VectorXd file_values(const DescribedRobot& robot, const RobotSource& source,
                            const std::string& why);

}  // namespace dyngen::runtime
