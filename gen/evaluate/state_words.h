// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "gen/model/robot_model.h"

namespace dyngen {

/// A number that stands for an unknown one of the robot file: "XX2", "d3".
struct GivenValue {
  std::string name;
  GiNaC::ex value = 0;  ///< exact
};

/// A motion of the robot at one moment, one value per moving joint.
struct StateRequest {
  std::vector<double> q;    ///< rad, m
  std::vector<double> dq;   ///< rad/s, m/s
  std::vector<double> ddq;  ///< rad/s^2, m/s^2
  std::vector<GivenValue> given;
};

/// Reads "q=0.1,pi/2 dq=0,1 XX2=0.3": names with one value or several, commas or blanks between.
/// Values are expressions as robot files have them, without the robot file's `let` names. dq and
/// ddq are 0 where they do not stand.
/// @param words  of the command line; the same in one word or in several
/// @throws std::invalid_argument  with the place in the words: a value that cannot be read, a name
///         that stands twice, a number of values that is not that of the moving joints, q missing
StateRequest read_state(const std::vector<std::string>& words, const RobotModel& model);

}  // namespace dyngen
