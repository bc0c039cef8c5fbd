// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "runtime/recordings/recording.h"
#include "tests/studies/fourier_motion.h"
#include "tests/support/numeric_robot.h"

namespace dyngen::test {

/// A controller, its sensors, and how long it is watched.
struct ClosedLoopOptions {
  double sample_time = 1e-3;  ///< s, of controller and recording
  double seconds = 20;        ///< that are recorded
  double lead_in = 2;         ///< s before the recording: what the start leaves is gone then
  Eigen::VectorXd stiffness;  ///< (n) kp, N m/rad
  Eigen::VectorXd damping;    ///< (n) kd, N m s/rad
  double velocity_hz = 60;    ///< of the first-order low-pass behind the encoder's difference
  /// Computed torque besides: inverse dynamics of this robot at the reference. None: plain PD.
  std::optional<NumericRobot> feedforward;
  Eigen::VectorXd encoder_step;  ///< (n) rad or m; 0: exact positions
  Eigen::VectorXd torque_noise;  ///< (n) standard deviation of recorded torque, N m or N
  double coloured_part = 0.5;    ///< of the noise's variance that is AR(1)
  double pole = 0.9;             ///< of the AR(1) part, per sample
  double wild_part = 0;          ///< of the torque samples that are off by 10 to 40 deviations
  /// Torque is held from one sample to the next. Recorded is the mean of what is held before and
  /// after a sample; false: what is held after it, half a sample early.
  bool centred_torque = true;
};

/// What the plant did, and what of it was recorded.
struct ClosedLoopRun {
  runtime::Recording measured;   ///< quantised q, noisy tau; tau_sim is tau without its noise
  runtime::Recording truth;      ///< true q, dq, ddq; tau as measured
  runtime::Recording reference;  ///< q, dq, ddq that were asked for; tau as measured
};

/// A robot under PD control of positions that an encoder rounds, so that torque and measured motion
/// share the encoder's error, as in any closed loop.
///
/// Plant: Runge and Kutta's fourth order at the sample time, torque held over a sample. ddq is
/// solved from inverse dynamics by refinement with a mass matrix that is renewed every fourth
/// sample, down to 1e-9 of the torque. Coulomb friction has no smooth zone: reversals are located
/// within a step, and a joint stands while |torque| <= Fs.
///
/// 22 s of a seven-joint robot are 22000 steps of about 20 inverse dynamics: a few seconds.
/// @throws std::runtime_error  if the motion does not stay finite (gains)
ClosedLoopRun simulate(const NumericRobot& robot, const FourierMotion& motion,
                       const ClosedLoopOptions& options, unsigned seed);

/// Gains of a PD controller of `hz` and the damping ratio 1, from M's diagonal at `q`.
void set_gains(const NumericRobot& robot, const Eigen::VectorXd& q, double hz,
               ClosedLoopOptions& options);

/// Motion and torque of a robot without noise or controller: what estimates are held against.
runtime::Recording clean_recording(const NumericRobot& robot, const FourierMotion& motion,
                                   double seconds, double sample_time);

}  // namespace dyngen::test
