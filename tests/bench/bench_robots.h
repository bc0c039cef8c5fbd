// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gen/model/robot_model.h"

namespace dyngen::bench {

/// The robot files of the project, by name.
std::vector<std::filesystem::path> project_robots();

/// Which parameters of every link are made unknown, whatever the file says of them.
enum class Unknown {
  kInertial,          ///< the ten inertial ones; rotor inertia, friction and offset are taken away
  kDiagonal,          ///< as kInertial, products of inertia are zero
  kSymmetric,         ///< as kDiagonal, and centres of mass are on the joints' axes
  kInertialAndDrive,  ///< also IA, Fs and Fv of the moving joints; offset is taken away
};

/// The robot's geometry with unknown parameters: what a generator sees before an identification.
RobotModel with_unknown_parameters(RobotModel model, Unknown unknown);

/// Text of a robot file: `joints` revolute joints, alpha +-pi/2, no length zero, all unknown.
std::string generic_chain(int joints);

}  // namespace dyngen::bench
