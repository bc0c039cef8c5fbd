// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/effects/effect_law.h"

namespace dyngen::runtime {

/// The motion on which signatures are drawn: a pendulum of 10 kg and half a metre that swings in
/// gravity about a horizontal axis, with a partner beside it that swings another way. 10 s.
struct PendulumRun {
  double sample_time = 0;
  Eigen::VectorXd time, distance;  ///< s; rad travelled since the last reversal
  Eigen::MatrixXd variables;       ///< (N x nv) of the law
};
PendulumRun pendulum_run(const EffectLaw& law);

/// A variable of that motion, (N); also "distance".
Eigen::VectorXd pendulum_signal(const std::string& name);

/// Sizes of the pendulum's joint.
EffectScales pendulum_scales();

}  // namespace dyngen::runtime
