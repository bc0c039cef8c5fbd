// SPDX-License-Identifier: MIT
// What a logger writes of a recording.
#pragma once

#include "tests/blind/cases/whitening.h"

namespace blind {

/// What a logger does to the columns. Strengths and oracles know of it: they belong to the columns
/// without it.
struct Logger {
  double jitter = 0;         ///< time stamps are late by up to so many samples
  double digit = 0;          ///< s, to which time stamps are rounded; 0: they are exact
  Eigen::Index late = 0;     ///< samples that positions are late
  Eigen::VectorXd gain;      ///< (j) of the torque; empty: 1
  std::uint64_t stamps = 0;  ///< seed of the jitter
};

/// Columns of a file. (N): rows, (j): joints.
struct Columns {
  Eigen::VectorXd time;             ///< s
  Eigen::MatrixXd q, tau, qd, qdd;  ///< (N x j); velocities and accelerations are the simulation's
};

Columns columns_of(const Recording& recording, const Logger& logger);

}  // namespace blind
