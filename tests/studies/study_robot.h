// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/studies/closed_loop.h"
#include "tests/studies/fourier_motion.h"

namespace dyngen::test {

/// A robot whose truth is known, with a controller and sensors.
struct StudyRobot {
  std::string name;
  runtime::DescribedRobot described;
  NumericRobot truth;    ///< the plant
  Eigen::VectorXd beta;  ///< grouping * standard parameters of the truth
  MotionLimits limits;
  ClosedLoopOptions loop;
};

/// "puma3", "ur10e" or "panda": robots/<name>.robot beside this file.
/// @throws std::invalid_argument
StudyRobot study_robot(const std::string& name);

const std::vector<std::string>& study_robot_names();

}  // namespace dyngen::test
