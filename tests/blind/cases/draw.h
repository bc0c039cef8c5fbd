// SPDX-License-Identifier: MIT
// What a case is made of, before anything moves.
#pragma once

#include "tests/blind/cases/case.h"

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
  std::vector<Truth> truths;
  std::uint64_t noise_seed = 0;
};

std::optional<Draft> draw_case(const CaseOptions& options, const std::string& arms);

}  // namespace blind
