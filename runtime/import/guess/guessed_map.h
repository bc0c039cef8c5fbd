// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/import/guess/sampled_log.h"
#include "runtime/import/imported_rows.h"

namespace dyngen::runtime {

/// What a guess may know of the robot; vectors are empty where nothing is known.
struct GuessRobot {
  ImportedRobot joints;
  Eigen::VectorXd lowest, highest;  ///< (n) rad or m; infinite: not known
  Eigen::VectorXd gravity_torque;   ///< (n) N m, the largest over many poses
};

/// A map with a comment for each guess: its reason and how sure it is. What the log does not decide
/// is a question ('?') that has to be answered before the map can be used.
struct GuessedMap {
  std::string yaml;
  int questions = 0;
};

/// Names say what columns are, ranges and derivatives say units, sides and rates.
/// @throws ImportError  if no column looks like a position
GuessedMap guess_map(const SampledLog& logs, const GuessRobot& robot);

}  // namespace dyngen::runtime
