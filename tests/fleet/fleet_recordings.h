// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/model/linear_model.h"
#include "runtime/recordings/recording.h"

namespace dyngen::test {

/// What a machine of the fleet records: every joint follows five sines of its own, torques are the
/// model's with noise. The same seed gives the same recording.
struct FleetMotion {
  double seconds = 10, rate = 500;  ///< rate in Hz
  double amplitude = 0.25;          ///< rad or m, of each sine
  double torque_noise = 0.05;       ///< N m or N
  double position_noise = 1e-6;     ///< rad or m
};
runtime::Recording fleet_recording(const runtime::LinearModel& model, unsigned seed,
                                   const FleetMotion& motion);

/// The file's values; where it has none, made-up ones.
Eigen::VectorXd fleet_parameters(const runtime::LinearModel& model);

}  // namespace dyngen::test
