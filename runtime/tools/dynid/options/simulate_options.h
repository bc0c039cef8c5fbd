// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gen/robot_input/robot_source.h"
#include "runtime/tools/dynid/options/loop_settings.h"

namespace CLI {
class App;
}

namespace dyngen::runtime {

/// The command line of `dynid simulate`. Lists have one value for all joints, or one a joint.
struct SimulateOptions {
  RobotSource robot;       ///< the controller's model, and the plant unless there is one
  RobotSource plant;       ///< another robot file; empty: the same
  std::string trajectory;  ///< CSV
  std::string output;      ///< the recording
  std::string truth;       ///< the motion without encoder and noise; empty: none
  std::string picture;     ///< .svg or .png; empty: none
  LoopSettings loop;
  std::vector<double> torque_noise = {0};  ///< N m or N
  double duration = 0;                     ///< s; 0: the trajectory's
  std::uint64_t seed = 1;
  std::vector<double> start;               ///< position; empty: the trajectory's first sample
  std::vector<double> temperature = {25};  ///< of all joints; two: at the start and at the end
  std::vector<std::string> effects;        ///< folders of a user's own effects
};

/// Adds the subcommand to the command line. @param map  of --map
void add_simulate(CLI::App& tool, std::string& map, SimulateOptions& options);

}  // namespace dyngen::runtime
