// SPDX-License-Identifier: MIT
// One run of a case's machine: its plant, its loop, its sensors.
#pragma once

#include "tests/blind/cases/draw.h"

namespace blind {

/// What one recording is of.
struct Ride {
  Motion motion;
  double lead = 1;        ///< s that are run before the first sample
  double duration = 0;    ///< s that are recorded
  std::size_t place = 0;  ///< among the recordings of the case: which truths act, which noise
};

/// The recordings that a draft foresees: training, then held out.
Ride ride_of(const Draft& draft, std::size_t place);

/// Simulates, with some truths at their sizes; without torque noise.
/// @throws std::runtime_error  where the machine runs away
Recording record(const Draft& draft, const std::vector<Truth>& truths,
                 const std::vector<double>& sizes, const Ride& ride);

/// Standard deviation of the torque noise, (j) N m: a share of the torque of the machine as its
/// model has it, on the first training motion.
Eigen::VectorXd noise_deviation(const Draft& draft);

/// Torque noise of the recordings from the first place on.
void add_noise(const Draft& draft, const Eigen::VectorXd& deviation, std::vector<Recording>& all);

/// Torque noise of the recording at one place; the same as among all.
void add_noise_at(const Draft& draft, const Eigen::VectorXd& deviation, std::size_t place,
                  Recording& recording);

/// Noise of the recordings from the first place on, of any draw.
DrawNoise noise_draws(const Draft& draft, const Eigen::VectorXd& deviation);

/// Makes the noise of a case's equations white: by its training motions of the machine as its model
/// has it, and many draws of its noise.
Whitener whitener_of(const Draft& draft, const Eigen::VectorXd& deviation);

}  // namespace blind
