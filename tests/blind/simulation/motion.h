// SPDX-License-Identifier: MIT
// What the arms are told to do.
#pragma once

#include <functional>

#include "tests/blind/simulation/random.h"
#include "tests/blind/simulation/tree.h"

namespace blind {

/// Motions use so much of an arm's limits.
constexpr double kSpeed = 0.75, kAcceleration = 0.8, kRange = 0.9;

/// Position, velocity and acceleration of all joints at one time.
struct Wanted {
  Eigen::VectorXd q, dq, ddq;
};

struct Motion {
  double duration = 0;  ///< s of one period, or of all of a motion that does not repeat
  bool repeats = false;
  std::function<Wanted(double t)> at;
};

/// A Fourier series that keeps to the arm's limits, with a period of duration.
Motion fourier_motion(const Arm& arm, double duration, Random random, Eigen::Index harmonics = 5);

/// How an arm goes from posture to posture.
struct Moves {
  double speed = 0.75;                             ///< at most, of the arm's limit
  double shortest_rest = 0.1, longest_rest = 0.4;  ///< s, between moves
};

/// From posture to posture with rests, by polynomials of the fifth degree.
Motion point_to_point(const Arm& arm, double duration, Random random, const Moves& moves_of = {});

/// Every joint on its own: from place to place at constant speeds of 5 to 75 % of its limit, with
/// short rests.
Motion speed_steps(const Arm& arm, double duration, Random random);

/// One joint after another moves so, while the others stand.
Motion single_joint_sweeps(const Arm& arm, double duration, Random random);

/// Irregular and smooth: every joint follows noise between 0.05 and 1.2 Hz.
Motion irregular_motion(const Arm& arm, double duration, Random random);

/// Every joint swings faster and faster, or slower and slower, between 0.1 and up to 3 Hz.
Motion chirps(const Arm& arm, double duration, Random random);

/// A Fourier series of some periods that swells from a posture and dies away to it, with rests
/// before and after.
Motion ramped_motion(const Arm& arm, double duration, int periods, Random random);

}  // namespace blind
