// SPDX-License-Identifier: MIT
// What the arms are told to do.
#pragma once

#include <functional>

#include "tests/blind/simulation/random.h"
#include "tests/blind/simulation/tree.h"

namespace blind {

/// Position, velocity and acceleration of all joints at one time.
struct Wanted {
  Eigen::VectorXd q, dq, ddq;
};

struct Motion {
  double duration = 0;  ///< s of one period, or of all of a motion that does not repeat
  bool repeats = false;
  std::function<Wanted(double t)> at;
};

/// A Fourier series of five harmonics that keeps to the arm's limits, with a period of duration.
Motion fourier_motion(const Arm& arm, double duration, Random random);

/// From posture to posture with short rests, by polynomials of the fifth degree.
Motion point_to_point(const Arm& arm, double duration, Random random);

}  // namespace blind
