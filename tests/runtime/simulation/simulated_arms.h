// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/recordings/trajectory_file.h"
#include "tests/support/numeric_robot.h"

namespace dyngen::test {

/// Three links that swing in a vertical plane, with rotors and friction.
NumericRobot planar_arm();

/// A mass on a horizontal slide: M = 2 kg, Fs = 3 N, Fv = 0.
NumericRobot slide();

/// q_j = amplitude (1 - cos(w_j t)), from rest.
runtime::Trajectory cosine_trajectory(Eigen::Index joints, double seconds, double amplitude,
                                      double hz);

/// The same positions all the time.
runtime::Trajectory constant_trajectory(const Eigen::VectorXd& q, double seconds);

}  // namespace dyngen::test
