// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>

#include "runtime/control/controller.h"
#include "runtime/recordings/recording.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/simulation/plant.h"
#include "runtime/simulation/torque_noise.h"

namespace dyngen::runtime {

/// A loop of sensors, controller and drive, and how long it is watched.
struct ClosedLoopOptions {
  /// Hz, of controller and recording: torque is held from one sample to the next.
  double rate = 1000;
  /// The controller acts at every moment instead, for proofs; `rate` is that of the recording
  /// alone. Sensors must be exact then, and the delay 0.
  bool continuous = false;
  double delay = 0;                ///< s, from a sample to its torque at the joints
  double duration = 0;             ///< s; 0: as long as the trajectory
  Eigen::VectorXd encoder_step{};  ///< (n) rad or m, positions are rounded to it; empty or 0: exact
  /// Standard deviation of white noise in the positions before they are rounded, in encoder steps:
  /// 0: the same motion shows the same digits again, which hardly any real drive does.
  double encoder_noise = 0;
  double velocity_cutoff_hz = 0;  ///< Hz, of VelocityFilter behind the encoder; 0: exact velocity
  TorqueNoiseOptions torque_noise{};  ///< of the recorded torque; the drive's has none
  std::uint64_t seed = 1;
  IntegrationOptions integration{};

  /// @throws std::invalid_argument  naming the option, what was found and what was expected
  void validate(int joints) const;
};

/// Where a simulation begins.
struct StartState {
  Eigen::VectorXd q, dq;
};

struct ClosedLoopRun {
  /// What sensors saw, one row a sample: time, q, dq as the controller got them, tau with its
  /// noise. tau of a sample is the mean of what the drive held before and after it.
  Recording measured;
  /// q, dq, ddq and tau without noise, at the same times; of drives, where joints have springs.
  Recording truth;
  /// The same of the links: another motion behind springs alone.
  Recording links;
  Eigen::MatrixXd reference;        ///< (N x n) q_ref
  Eigen::VectorXd largest_torque;   ///< (n) N m or N, of the drive
  Eigen::VectorXd saturated_share;  ///< (n) of the samples at the torque limit
  Eigen::VectorXd stuck_share;      ///< (n) of the time that friction held the joint
  PlantCounts counts;
};

/// A robot that follows a trajectory under a controller. Sensors, controller and torque are those
/// of the drives; springs carry the links where it begins.
///
/// Each sample: the encoder's position and its velocity go to the controller, whose torque acts
/// `delay` later and is held. Before the first torque arrives the drive holds the first one. The
/// same options and seed give the same run.
/// @param plant       what moves: its parameters may differ from the controller's model
/// @param trajectory  from its first time on; after its end the robot is asked to stand
/// @param start       none: the trajectory's first position and velocity
/// @param progress    told the share that is done, 0 .. 1; may be empty
/// @throws std::invalid_argument  if sizes or options are wrong
/// @throws std::runtime_error     if the motion does not stay finite
ClosedLoopRun simulate(const PlantModel& plant, Controller& controller,
                       const Trajectory& trajectory, const ClosedLoopOptions& options,
                       const std::optional<StartState>& start = {},
                       const std::function<void(double)>& progress = {});

/// How well a run follows: of the true positions.
struct Tracking {
  Eigen::VectorXd rms, worst;  ///< (n) rad or m
};
Tracking tracking_of(const ClosedLoopRun& run);

}  // namespace dyngen::runtime
