// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/model/linear_model.h"
#include "runtime/plausibility/trial_fit.h"

namespace dyngen::runtime {

/// A reading with its name.
struct NamedReading {
  std::string kind;  ///< of Remark
  int joint = 0;     ///< from 1; 0: no single one
  std::string what;  ///< "positions are in degrees"
  std::string cure;  ///< "multiply them by pi/180"
  Reading reading;
};

/// Other units of all positions and of time.
std::vector<NamedReading> other_units(const LinearModel& model, const Reading& base);

/// Turned signs of each joint's position, torque, and both.
/// @param judged  (n) joints with equations: others would only change the posture that hides them
std::vector<NamedReading> turned_signs(const Reading& base, const std::vector<bool>& judged);

/// A joint's columns and another's in each other's place: positions, torques, and both.
/// @param joint  from 0
/// @param with   (n) joints that move together with it: the torque of one that stands is as smooth
///               as gravity, and any model explains it
std::vector<NamedReading> swapped_columns(const Reading& base, int joint,
                                          const std::vector<bool>& with);

}  // namespace dyngen::runtime
