// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/effects/effect_recordings.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// What recordings do not say of the model's torque on others: for each joint the variance of the
/// predicted torque, from the covariance of the parameters that were fitted to the first, over that
/// of the residual. A combination of parameters that the first do not determine at all, as in the
/// posture of joints that stand, is taken to be as large as the others. (n) mean over all
/// equations; p/N where both move alike, above 1 a prediction is worth less than none.
Eigen::VectorXd predicted_variance(const EffectRecordings& train, const EffectRecordings& heldout);

/// Equations of a joint that count, over all runs.
double equations_of_joint(const EffectRecordings& data, int joint);

/// A joint of which nothing is said: too few equations of it are fitted.
struct UnjudgedJoint {
  int joint = 0;         ///< coordinate, from 0
  double equations = 0;  ///< that it has
  double needed = 0;     ///< that it would need
  std::string why;       ///< a clause: "joint 3 stands in all fitted recordings"
};

/// Joints with fewer fitted equations than EquationRules::least_equations beyond twice the
/// parameters that their equations determine. A joint that stands has none. In the posture of a
/// joint that stands, another joint's equations determine fewer parameters than its model has.
std::vector<UnjudgedJoint> unjudged_joints(const EffectRecordings& train,
                                           const EquationRules& rules = {});

/// Why recordings cannot carry a test: no joint has equations enough; empty: they can.
/// @param joints  of the robot
std::string why_too_few(const std::vector<UnjudgedJoint>& unjudged, int joints);

/// Why recordings in which nothing was found cannot be called clean: what they leave open of the
/// parameters moves the held-out torque too much; empty: they can.
std::string why_too_little_motion(const EffectRecordings& train, const EffectRecordings& heldout,
                                  const EquationRules& rules = {});

}  // namespace dyngen::runtime
