// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/effects/effect_recordings.h"

namespace dyngen::runtime {

/// Takes out the equations of joints that stand: at rest friction holds any torque up to its own,
/// which no law of sliding friction describes. A joint stands where it stays below the speed for a
/// tenth of a second or more; passing through zero at a reversal is quicker, and stays in.
/// @param run          its rows change
/// @param still_speed  (n) rad/s or m/s
void leave_out_standstill(EffectRun& run, const Eigen::VectorXd& still_speed);

}  // namespace dyngen::runtime
