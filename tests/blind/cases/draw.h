// SPDX-License-Identifier: MIT
// What a case is made of, before anything moves.
#pragma once

#include "tests/blind/cases/case.h"
#include "tests/blind/cases/habit.h"

namespace blind {

/// Everything that a seed decides.
struct Draft {
  Arm arm;
  Machine machine;
  Machine believed;  ///< the controller's
  MakeEngine engine = mujoco_engine;
  LoopOptions loop;
  Noise noise;  ///< deviations as shares of the torque's rms
  double rate = 250;
  std::vector<Motion> motions;  ///< training, then held out
  std::size_t training = 3;
  int periods = 5;
  Logger logger;
  Eigen::VectorXd disturbance;   ///< (j) deviation of the torque in the loop, N m; empty: none
  double disturbance_share = 0;  ///< the same over the torque's rms
  double memory = 0;             ///< of it, s
  Eigen::VectorXd compensation;  ///< (j) share of the friction that the drive adds; empty: none
  std::vector<Truth> truths;
  std::vector<double> wanted;  ///< strength of each truth
  std::uint64_t noise_seed = 0;
};

std::optional<Draft> draw_case(const CaseOptions& options, const std::string& arms);

}  // namespace blind
