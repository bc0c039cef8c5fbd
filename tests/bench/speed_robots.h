// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "gen/model/robot_model.h"
#include "gen/program/program.h"
#include "tests/bench/speed_states.h"
#include "tests/support/numeric_robot.h"

namespace dyngen::bench {

/// Calls a function on the first `count` states; results of state k go to out + k * stride.
using Sweep = void (*)(const States&, std::size_t count, double* out, std::size_t stride);

/// The sweep of call(sample, out), a lambda without captures.
template <typename Call>
constexpr Sweep sweep(Call /*call*/) {
  return [](const States& states, std::size_t count, double* out, std::size_t stride) {
    for (std::size_t k = 0; k < count; ++k) Call{}(states.sample(k), out + k * stride);
  };
}

/// The emitted functions of one robot under one set of compiler flags.
struct Emitted {
  std::map<std::string, Sweep> sweeps;  ///< by the function's name; "id libm": --trig libm
  void (*id_batch)(const Rows<double>&, double* tau) = nullptr;
  void (*id_batch_float)(const Rows<float>&, float* tau) = nullptr;
  std::vector<double> chi;  ///< the base parameters, as numbers
};

struct SpeedRobot {
  std::string name;
  RobotModel model;
  test::NumericRobot numbers;  ///< for the judge and the peers
  Emitted plain;               ///< -O2
  Emitted native;              ///< -O3 -march=native -ffp-contract=fast
  Program id;                  ///< for evaluate()
};

/// Puma 560, UR10e, Panda: the robot files with drives, their numbers in the code.
std::vector<SpeedRobot> robots_of_files();

/// Puma 560 and Panda as rigid bodies: ten inertial parameters of every link, none of them zero,
/// read from chi as base parameters.
std::vector<SpeedRobot> robots_at_run_time();

}  // namespace dyngen::bench
