// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include "runtime/recordings/recording.h"

namespace dyngen::runtime::test {

/// Slow noise of a torque: white, and parts that are forgotten with a time each.
struct MadeNoise {
  double white = 0.3;                     ///< N m, of a sample
  std::vector<double> memory = {0.3};     ///< s
  std::vector<double> deviation = {0.2};  ///< N m
};
/// Parts whose sum has a spectrum like 1/f from 0.003 to 5 Hz.
MadeNoise pink_noise();

/// N samples of it from a stationary beginning.
Eigen::VectorXd noise_of(const MadeNoise& noise, Eigen::Index samples, double sample_time,
                         std::mt19937& random);

/// A joint that runs at ten speeds in both directions, and another one that stands.
struct MadeJoint {
  std::vector<double> speeds = {0.02, 0.034, 0.056, 0.093, 0.155, 0.26, 0.43, 0.72, 1.2, 2.0};
  double seconds = 6;  ///< of a run, at most 2.5 rad
  double sample_time = 0.01;
  double cosine = 12, sine = 5, offset = 1.5;  ///< N m: gravity; a constant
  std::function<double(double)> friction;      ///< N m, of the speed
  MadeNoise noise;
  double position_noise = 1e-5;  ///< rad
};

std::shared_ptr<const Recording> made_recording(const MadeJoint& joint, unsigned seed);

}  // namespace dyngen::runtime::test
