// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/evidence/joint_columns.h"
#include "runtime/evidence/torque_noise_model.h"

namespace dyngen::runtime {

/// Torque that a disturbance inside the control loop would have, by the motion that follows it.
///
/// A disturbance d moves the arm: M qdd + h = tau + d. The planned motion is smooth, so that the
/// past predicts it; what an autoregressive process does not predict of the accelerations, their
/// innovations, is the arm's answer to the innovations of d. In a loop that holds, both have the
/// same instants. The innovations of every joint's accelerations, up to two equations early and
/// late, drive the noise process of a joint: these are its columns. Noise of the positions that the
/// controller follows is in both in the same way. Columns of effects are functions of the motion;
/// beside these columns the part of them that follows d is uncorrelated with d.
/// @param noise  of the same equations, as an autoregressive process for each joint
/// @return  for each joint that has equations its columns, behind the parallel filter, at most five
///          for each joint that moves; empty if none moves
/// Source: added regressors that show endogeneity (Hausman 1978); prediction errors in closed loop
///         (Ljung 1999, chapter 13).
std::vector<JointColumns> motion_innovations(const EffectRecordings& data,
                                             const TorqueNoiseModel& noise);

}  // namespace dyngen::runtime
