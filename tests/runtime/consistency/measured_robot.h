// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/consistency/consistent_parameters.h"

namespace dyngen::test {

/// A random physical robot and what a perfect identification of it would be summed up in.
struct MeasuredRobot {
  Eigen::VectorXd chi;                  ///< (14 links) the truth
  Eigen::VectorXd beta;                 ///< (nb) K chi
  runtime::ConsistencyProblem problem;  ///< z = R beta, no noise; prior NaN, all free
};

/// K by columns of the regressor that the judge (tests/support/numeric_dynamics.h) gives on random
/// states; R its triangular factor for a torque noise of `sigma` N m.
MeasuredRobot measured_robot(unsigned seed, int links, double sigma);

/// z with unit noise added.
void add_noise(runtime::ConsistencyProblem& problem, unsigned seed);

}  // namespace dyngen::test
