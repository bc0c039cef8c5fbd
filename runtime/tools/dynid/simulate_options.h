// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dyngen::runtime {

/// The command line of `dynid simulate`. Lists have one value for all joints, or one a joint.
struct SimulateOptions {
  std::string robot;       ///< the controller's model, and the plant unless there is one
  std::string plant;       ///< another robot file; empty: the same
  std::string trajectory;  ///< CSV
  std::string output;      ///< the recording
  std::string truth;       ///< the motion without encoder and noise; empty: none
  std::string picture;     ///< .svg or .png; empty: none
  std::string controller = "ct";
  double rate = 1000;                      ///< Hz; 0: a continuous controller
  double bandwidth = 3;                    ///< Hz
  double damping = 1;                      ///< ratio
  std::vector<double> encoder = {0};       ///< rad or m
  double velocity_cutoff = 0;              ///< Hz; 0: exact
  std::vector<double> torque_noise = {0};  ///< N m or N
  double delay = 0;                        ///< s
  double duration = 0;                     ///< s; 0: the trajectory's
  std::uint64_t seed = 1;
  std::string friction = "auto";  ///< on, off, auto: on where the law has a model
  std::string friction_velocity = "reference";
  std::vector<double> friction_band = {0.02};  ///< rad/s or m/s
  std::string saturate = "on";
  std::vector<double> start;               ///< position; empty: the trajectory's first sample
  std::vector<double> temperature = {25};  ///< of all joints; two: at the start and at the end
  std::vector<std::string> effects;        ///< folders of a user's own effects
  double tolerance = 1e-10;                ///< of integration

  /// Of a recording whose controller is continuous.
  static constexpr double kContinuousRecordRate = 1000;
};

/// Adds the subcommand to the command line.
void add_simulate(CLI::App& tool, SimulateOptions& options);

}  // namespace dyngen::runtime
