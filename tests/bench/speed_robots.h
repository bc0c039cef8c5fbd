// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gen/program/program.h"
#include "tests/support/oracle_data.h"

namespace dyngen::bench {

inline constexpr std::size_t kStates = 4096;

/// Random states, one after the other: sample k begins at [k * joints].
struct States {
  std::size_t joints = 0;
  std::vector<double> q, dq, ddq;
};

/// q in +-pi rad, dq in +-3 rad/s, ddq in +-10 rad/s^2, the same on every run.
States random_states(std::size_t joints);

/// The emitted functions of one robot under one set of compiler flags.
struct Compiled {
  void (*id)(const double* q, const double* dq, const double* ddq, double* tau) = nullptr;
  void (*gravity)(const double* q, double* tau) = nullptr;
};

struct SpeedRobot {
  std::string name;
  test::Oracle oracle;  ///< the same robot as numbers: what the peers are built from
  Compiled plain;       ///< -O2
  Compiled native;      ///< -O3 -march=native -ffp-contract=fast
  Program id;           ///< for evaluate()
};

/// Puma 560, UR10e, Panda.
std::vector<SpeedRobot> speed_robots();

}  // namespace dyngen::bench
