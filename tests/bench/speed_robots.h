// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gen/program/program.h"
#include "tests/support/oracle_data.h"

namespace dyngen::bench {

/// The emitted functions of one robot under one set of compiler flags. All but `id_baked` read
/// run-time base parameters, of links without a zero; they have no rotors and no friction.
struct Emitted {
  using Torque = void (*)(const double* q, const double* dq, const double* ddq, const double* chi,
                          double* out);
  using Configuration = void (*)(const double* q, const double* chi, double* out);

  Torque id = nullptr, id_libm = nullptr, base_regressor = nullptr, fd = nullptr;
  Configuration gravity = nullptr, mass_matrix = nullptr;
  void (*id_derivatives)(const double* q, const double* dq, const double* ddq, const double* chi,
                         double* D_q, double* D_dq, double* D_ddq) = nullptr;
  void (*id_batch)(std::size_t n, const double* q, const double* dq, const double* ddq,
                   const double* chi, double* tau) = nullptr;
  void (*id_batch_float)(std::size_t n, const float* q, const float* dq, const float* ddq,
                         const float* chi, float* tau) = nullptr;
  /// The robot file's numbers stand in the code, rotors and friction too.
  void (*id_baked)(const double* q, const double* dq, const double* ddq, double* tau) = nullptr;
};

struct SpeedRobot {
  std::string name;
  test::NumericRobot numbers;  ///< what the peers are built from; links that could be built
  std::vector<double> chi;     ///< the same as base parameters
  std::vector<test::OracleState> stored;  ///< of id_baked
  Emitted plain;                          ///< -O2
  Emitted native;                         ///< -O3 -march=native -ffp-contract=fast
  Program id;                             ///< for evaluate()
};

/// Puma 560, UR10e, Panda.
std::vector<SpeedRobot> speed_robots();

}  // namespace dyngen::bench
