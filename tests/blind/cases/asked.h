// SPDX-License-Identifier: MIT
// One more recording of a case that has been made already, along a motion that was asked for.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tests/blind/cases/record.h"

namespace blind {

/// A commanded motion with the header time,q1..qn,qd1..qdn,qdd1..qddn. Between rows, positions are
/// the polynomials of the fifth degree that have both rows' positions, velocities, accelerations.
/// A motion whose last row is its first one repeats; another one has to begin at rest.
/// @throws std::runtime_error  with the file, and the line where there is one
Motion read_motion(const std::string& path, Eigen::Index joints);

/// A case as its entry of the manifest says it: the same machine, physics and noise.
struct Redrawn {
  Draft draft;
  std::vector<double> sizes;
  Eigen::VectorXd deviation;  ///< of the torque noise, (j) N m
};

/// @throws std::runtime_error  where what the seed draws is not what the entry says
Redrawn redraw(const nlohmann::json& entry, const std::string& arms);

/// A recording at one place of those that were made, byte for byte the same.
Recording record_again(const Redrawn& redrawn, std::size_t place);

/// All that were fitted.
std::vector<Recording> training_again(const Redrawn& redrawn);

/// A recording along another motion, with noise of its own. What happens once in a recording of
/// the case does not happen here.
Recording record_along(const Redrawn& redrawn, const Motion& motion);

}  // namespace blind
