// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// A row of the file for the moving joints; infinite where it is absent or unknown. @return (n)
Eigen::VectorXd row_values(const DescribedRobot& robot, RowKey key);

}  // namespace dyngen::runtime
