// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/control/control_model.h"
#include "runtime/simulation/plant_model.h"

namespace dyngen::runtime {

/// A robot file as simulation and control see it: its functions are the generator's own programs,
/// evaluated without a compiler. The functions keep buffers: one thread at a time; copies are
/// apart.
struct SimulatedRobot {
  std::string name;
  std::vector<std::string> joint_names;
  std::vector<bool> revolute;
  ControlModel control;
  PlantModel plant;              ///< without `forward` unless it was asked for
  Eigen::VectorXd torque_limit;  ///< (n) taumax of the file; infinite where there is none
  std::vector<std::string> warnings;

  [[nodiscard]] int joints() const { return control.joints; }
};

enum class RobotUse {
  kController,  ///< all but forward dynamics
  kPlant,       ///< all; the file must describe bodies that can be accelerated
};

/// @throws ModelError  positioned: something is '*' (numbers are needed), Fs is negative; or the
///         mass matrix of a plant is singular everywhere
SimulatedRobot read_simulated_robot(const std::string& path, RobotUse use);

}  // namespace dyngen::runtime
