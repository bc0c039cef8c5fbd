// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/effect_file/effect_file.h"
#include "gen/program/program.h"

namespace dyngen {

/// The equations of an effect as programs that are evaluated: for any robot, one joint at a time.
///
/// Arrays: v (variables in the order of EffectFile::variables), p (parameters, shared by samples),
/// z (states), m (variables in the middle of a step), h (step, s).
struct EffectPrograms {
  Program torque;        ///< v p z -> torque
  Program by_parameter;  ///< v p z -> slope: output o by parameter k at o * np + k
  Program by_linear;     ///< the same of parameters of role kLinear alone
  Program by_variable;   ///< v p z -> slope, by variables
  Program by_state;      ///< v p z -> slope, by states
  SplitProgram step;     ///< m p z h -> z, ahead of z and with it
  /// m p z h -> by_z (states x states), by_p (states x np), by_m (states x nv): of the states after
  /// the step
  Program step_slopes;
  /// v p z -> torque, rate, min, max: what a simulation integrates. A sign of anything but the
  /// joint's own velocity is tanh(1000 x). min and max hold the limits of states that have them.
  Program moment;
  std::vector<bool> has_min, has_max;  ///< of each state
  bool proportional = false;  ///< where all parameters of role kLinear are 0 there is no torque
};

EffectPrograms effect_programs(const EffectFile& effect);

}  // namespace dyngen
