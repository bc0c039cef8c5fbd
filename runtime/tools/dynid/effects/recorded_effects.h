// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/effects/effect_law.h"
#include "runtime/recordings/recording.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// What gains of the reading multiply.
enum class TorqueOfGains {
  kModel,    ///< the model's torque in this motion, as estimation does
  kRecorded  ///< `tau` of the recording: right also where friction holds a joint
};

/// Adds to recorded torques what effects of the rigid model and of the measurement change in them.
/// The motion is that of a robot without them.
///
/// Derivatives of the rigid model, gains and drifts are added as torque. A delay shifts the
/// recording (torque of a time T before; along straight lines between samples); behind a lag, what
/// is recorded is the command tau + T dtau/dt.
///
/// @param robot    with numbers for all parameters
/// @param effects  in `dynid simulate`, those that do not act while the robot moves
/// @param motion   one run, with q, dq, ddq, tau, all without noise; and a temperature, if an
///                 effect reads it
/// @return         (N x n) the recorded torque, without noise
Eigen::MatrixXd recorded_torque(const DescribedRobot& robot,
                                const std::vector<EffectInstance>& effects, const Recording& motion,
                                TorqueOfGains gains = TorqueOfGains::kModel);

}  // namespace dyngen::runtime
