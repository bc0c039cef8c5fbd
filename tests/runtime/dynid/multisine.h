// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "runtime/model/linear_model.h"
#include "runtime/recordings/recording.h"

/// Recordings whose truth is known, without a simulation: torque is what the model says of a
/// motion.
namespace dyngen::test {

struct MultisineOptions {
  double seconds = 10;
  double sample_time = 0.002;
  double period = 5;        ///< s; all frequencies are multiples of 1 / period
  double torque_noise = 0;  ///< standard deviation, N m
  double encoder_step = 0;  ///< rad
  double size = 1;          ///< of the motion: 1 is about a radian of each joint
  std::uint64_t seed = 1;
};

/// q, dq, ddq and torque of a motion of all joints.
runtime::Recording multisine(const runtime::LinearModel& model, const Eigen::VectorXd& beta,
                             const MultisineOptions& options);

/// Parameters that a robot could have: positive friction and inertia, small products.
Eigen::VectorXd plausible_beta(const runtime::LinearModel& model, std::uint64_t seed);

}  // namespace dyngen::test
