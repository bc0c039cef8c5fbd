// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/steady/friction_forms.h"
#include "runtime/steady/held_poses.h"
#include "runtime/steady/steady_levels.h"

namespace dyngen::runtime {

/// Friction at one speed, of all runs that have it.
struct FrictionPoint {
  double speed = 0;                      ///< rad/s or m/s, with its sign
  double torque = 0, low = 0, high = 0;  ///< N m or N, with its 95 % interval
  int runs = 0;
  double seconds = 0;
};

/// What runs of constant speed and held poses say of one joint.
struct SteadyResult {
  int joint = -1;  ///< from 0
  bool revolute = true;
  int runs = 0, postures = 0;
  int left_out = 0;                   ///< runs in which other joints move
  double seconds = 0;                 ///< of all runs
  std::vector<FrictionPoint> points;  ///< by ascending speed
  FrictionForms forms;
  HeldPairs poses;
  std::vector<std::string> remarks;

  [[nodiscard]] bool any() const { return runs > 0 || !poses.pairs.empty(); }
};

/// The friction curve of a joint, the form that it has, and its torque in held poses.
/// docs/explanation/steady_speeds.md has the method, its sources and its limits.
SteadyResult analyse_steady(const SteadyInput& input, const SteadyRules& rules);

/// What the form says, a sentence.
std::string friction_sentence(const SteadyResult& result);

}  // namespace dyngen::runtime
