// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace dyngen::runtime {

/// How far a simulated robot is from a recording of the real one.
struct SimulatedError {
  Eigen::VectorXd position;  ///< (n) rad or m, rms
  Eigen::VectorXd torque;    ///< (n) N m or N, rms
  std::string why_not;       ///< a sentence where it could not be simulated; both are empty then
};

/// Robots under a controller on motions that no parameter was fitted to, beside their recordings.
struct ForwardComparison {
  SimulatedError before;  ///< the model alone, fitted
  SimulatedError after;   ///< with the findings
  double seconds = 0;     ///< of recordings that were compared
  /// "controller pd, 3 Hz, on the commanded motion": how it was made.
  std::string how;
};

}  // namespace dyngen::runtime
