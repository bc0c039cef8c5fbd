// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "runtime/recordings/recording.h"
#include "runtime/recordings/trajectory_file.h"
#include "tests/studies/diagnosis_robot.h"

namespace dyngen::test {

/// How a robot of a case is moved and measured.
struct CaseSettings {
  double rate = 250;  ///< Hz, of the recording; 250 .. 500
  double period = 5;  ///< s
  int periods = 5;    ///< of each training recording
  double heldout_seconds = 15;
  bool closed_loop = false;
  int encoder_bits = 20;     ///< of a turn of the joint
  double encoder_noise = 0;  ///< steps of the encoder, in a loop
  double bandwidth = 4;      ///< Hz, of the controller
  bool temperature = false;

  [[nodiscard]] double train_seconds() const { return period * periods; }
};

/// Time before a recording, s: what the start of a controlled motion leaves is gone then.
constexpr double kLeadIn = 2;

/// Motions that are asked for: three of repeated periods for training, then a longer random one and
/// one from posture to posture. They begin kLeadIn before time 0.
std::vector<runtime::Trajectory> case_trajectories(const CaseRobot& robot,
                                                   const CaseSettings& settings,
                                                   std::mt19937_64& random);

/// What the machine did, and what its encoders said.
struct CaseMotion {
  runtime::Recording truth;  ///< q, dq, ddq; tau without noise and without recorded effects
  Eigen::MatrixXd encoder;   ///< (N x n) rad
};

/// The machine on a trajectory. In closed loop the effects that act on its motion act; without
/// it the motion is the trajectory, whatever acts.
/// @param acting  effects; those that change only what is recorded are left out
CaseMotion move(const CaseRobot& robot, const CaseSettings& settings,
                const runtime::Trajectory& trajectory,
                const std::vector<runtime::EffectInstance>& acting, std::uint64_t seed);

/// The torque that the measurement of a motion shows of effects, in addition to truth.tau: all of
/// them in open loop, in closed loop those that do not act. (N x n)
Eigen::MatrixXd recorded_share(const CaseRobot& robot, const CaseSettings& settings,
                               const CaseMotion& motion,
                               const std::vector<runtime::EffectInstance>& effects);

}  // namespace dyngen::test
