// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <random>
#include <string>

#include "runtime/recordings/recording.h"

namespace dyngen::test {

/// Physics that is not in the catalogue of effects.
struct ForeignTorque {
  std::string name;  ///< in words
  int joint = 0;     ///< on which it acts, from 0
  int kind = 0;
  double a = 0, b = 0, c = 0;  ///< of its shape
  int first = 0, second = 0;   ///< joints that it reads
  double size = 1;             ///< N m
};

/// One of them at random, of size 1.
ForeignTorque random_foreign_torque(int joints, std::mt19937_64& random);

/// Of a motion, N m of its joint. @param motion  q, dq, ddq without noise
Eigen::VectorXd foreign_torque(const ForeignTorque& foreign, const runtime::Recording& motion);

}  // namespace dyngen::test
