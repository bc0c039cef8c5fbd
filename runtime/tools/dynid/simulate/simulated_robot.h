// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "gen/effects/effect_catalogue.h"
#include "gen/robot_file/robot_file.h"
#include "runtime/control/control_model.h"
#include "runtime/effects/effect_law.h"
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
  /// What moves; without `forward` unless it was asked for. A joint that an effect twists has two
  /// coordinates in it (elastic_plant()).
  PlantModel plant;
  /// (n x n) of the rigid robot, row by row: what controllers are tuned by.
  std::function<void(const double* q, double* M)> mass_matrix;
  Eigen::VectorXd torque_limit;  ///< (n) taumax of the file; infinite where there is none
  /// Rows `effect` that change what is recorded, not the motion; those that act on the motion,
  /// twist a joint or let a drive lag are in the plant.
  std::vector<EffectInstance> recorded_effects;
  bool reads_temperature = false;    ///< some effect does
  std::vector<std::string> remarks;  ///< what was left out and why, a sentence each

  [[nodiscard]] int joints() const { return control.joints; }
};

enum class RobotUse {
  kController,  ///< all but forward dynamics
  kPlant,       ///< all; the file must describe bodies that can be accelerated
};

/// The temperature that effects of a plant read, in their unit.
struct SimulatedTemperature {
  double start = 25;
  double rate = 0;  ///< per second
};

/// A plant's effects act; a controller's model is without them.
/// @throws ModelError  positioned: something is '*' (numbers are needed), Fs is negative; an effect
///         is not known, or twists a joint whose drive has no inertia; or the mass matrix of a
///         plant is singular everywhere
SimulatedRobot read_simulated_robot(const RobotSource& source, RobotUse use,
                                    const EffectCatalogue& catalogue = {},
                                    const SimulatedTemperature& temperature = {});
/// The same of a file that was read.
SimulatedRobot simulated_robot(const RobotFile& file, RobotUse use,
                               const EffectCatalogue& catalogue = {},
                               const SimulatedTemperature& temperature = {});

}  // namespace dyngen::runtime
