// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/diagnosis/changes/changes.h"
#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::test {

/// The planar arm with links that loads can be mounted on: (0, 1) and the tip (-1, 0).
runtime::LinearModel arm_with_links();
runtime::EffectRobot arm_with_loads();

/// What a load on a link adds to the base parameters.
/// @param link  1 or 2
Eigen::VectorXd load_of(int link, double mass, double x, double y, double inertia);

/// Sessions of the arm: what changed, how many files, and how far they scatter.
struct ComparedArm {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(13);  ///< of the base parameters
  std::vector<runtime::EffectInstance> effects{};      ///< that came
  std::vector<runtime::EffectInstance> always{};       ///< of both sides, which the model lacks
  int before = 3, after = 3;                           ///< sessions
  double scatter = 0.05;  ///< standard deviation between sessions, of friction; of an offset: of Fc
  double noise = 0.1;     ///< N m
  double coefficient = 0.5;
  unsigned seed = 1;
};

/// A spring k q, a factor on a joint's torque and a constant, of each joint.
runtime::EffectLaw gain_law();
std::vector<runtime::EffectInstance> arm_effects();

runtime::ChangesSince changes_of(const ComparedArm& arm);

/// "friction_change 1" of the findings that are told with at least 0.5; joints from 1, 0: the last
/// link or the whole robot.
std::vector<std::string> names_of(const runtime::ChangesSince& changes);

}  // namespace dyngen::test
