// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>

#include "runtime/effects/effect_recordings.h"
#include "runtime/model/linear_model.h"

namespace dyngen::runtime {

/// A motion that can be looked at at any times of one period.
struct PlannedMotion {
  double duration = 0;  ///< s; it ends at rest where it began
  std::function<JointMotion(const Eigen::VectorXd& time)> at;
};

/// count instants of one period from 0 on; the end, which is the start again, is left out.
Eigen::VectorXd instants(const PlannedMotion& motion, Eigen::Index count);

/// A motion as if it had been recorded without noise, with the model's torque.
///
/// Joints that stand have no equations, as in a diagnosis. Positions have no encoder step, and
/// there is no parallel filter: every sample is an equation.
/// @param still_speed  (n) rad/s or m/s below which a joint stands
EffectRecordings planned_recording(const LinearModel& model, const EffectRobot& robot,
                                   const Eigen::VectorXd& beta, const PlannedMotion& motion,
                                   Eigen::Index samples, const Eigen::VectorXd& still_speed);

}  // namespace dyngen::runtime
