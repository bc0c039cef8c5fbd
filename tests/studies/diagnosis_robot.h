// SPDX-License-Identifier: MIT
#pragma once

#include <random>
#include <string>
#include <vector>

#include "runtime/tools/dynid/robot/described_robot.h"
#include "runtime/tools/dynid/simulate/simulated_robot.h"
#include "tests/studies/fourier_motion.h"

namespace dyngen::test {

/// A robot as its file says it, and the machine that was built: every body and actuator differs.
struct CaseRobot {
  std::string name;
  runtime::DescribedRobot told;   ///< what the diagnosis gets
  runtime::DescribedRobot built;  ///< the truth, with numbers
  Eigen::VectorXd beta;           ///< of the truth
  std::string told_path;
  std::string built_text;  ///< of its robot file
  MotionLimits limits;

  [[nodiscard]] int joints() const { return told.linear.joints(); }
  /// Place of a joint's parameter in built.standard. @param kind  of chi.h
  [[nodiscard]] double actuator(int joint, Chi kind) const;
};

/// puma3, ur10e and planar2: robots/<name>.robot beside this file.
const std::vector<std::string>& case_robot_names();

/// The bodies of the truth are the file's with another density, its actuators have other numbers:
/// each within +-`spread` of the file's.
/// @throws std::invalid_argument  if there is no such robot
CaseRobot case_robot(const std::string& name, std::mt19937_64& random, double spread = 0.2);

/// The machine that was built, so that it can be moved: without effects.
runtime::SimulatedRobot built_plant(const CaseRobot& robot);

}  // namespace dyngen::test
