// SPDX-License-Identifier: MIT
#pragma once

#include <random>

#include "runtime/recordings/recording.h"

/// Simulated recordings of an arm that moves, to be damaged.
namespace dyngen::test {

struct ArmMotion {
  Eigen::Index joints = 2, samples = 3000;
  double sample_time = 0.002;    ///< s
  double speed = 2;              ///< rad/s, about the fastest
  double position_noise = 2e-5;  ///< rad, standard deviation
  double encoder_step = 0;       ///< rad; 0: not quantised
  double torque_noise = 0.3;     ///< N m
};

/// One run: five sines of random frequency below 1.2 Hz a joint, torque of inertia, gravity and
/// friction, line k + 2 for row k.
runtime::Recording moving_arm(const ArmMotion& motion, std::mt19937& generator);

/// A uniformly distributed number.
double between(double low, double high, std::mt19937& generator);

/// A whole number, both ends included.
Eigen::Index whole_between(Eigen::Index low, Eigen::Index high, std::mt19937& generator);

}  // namespace dyngen::test
