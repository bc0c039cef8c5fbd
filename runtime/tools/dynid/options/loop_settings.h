// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace dyngen::runtime {

/// A loop of sensors, controller and drive on a command line. Lists have one value for all joints,
/// or one a joint.
struct LoopSettings {
  std::string controller = "ct";      ///< pd, gravity, ff, ct; empty: none is asked for
  double rate = 1000;                 ///< Hz; 0: a continuous controller
  double bandwidth = 3;               ///< Hz
  double damping = 1;                 ///< ratio
  std::vector<double> encoder = {0};  ///< rad or m
  double encoder_noise = 0;           ///< encoder steps
  double velocity_cutoff = 0;         ///< Hz; 0: exact
  double delay = 0;                   ///< s
  std::string friction = "auto";      ///< on, off, auto: on where the law has a model
  std::string friction_velocity = "reference";
  std::vector<double> friction_band = {0.02};  ///< rad/s or m/s
  std::string saturate = "on";
  double tolerance = 1e-10;  ///< of integration

  /// Of a recording whose controller is continuous.
  static constexpr double kContinuousRecordRate = 1000;
};

/// Adds the options of a loop to a command.
/// @return  all of them, --controller first
std::vector<CLI::Option*> add_loop_settings(CLI::App& command, LoopSettings& settings);

}  // namespace dyngen::runtime
