// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <string>

#include "tests/bench/speed_states.h"
#include "tests/support/numeric_robot.h"

namespace dyngen::bench {

/// A call on state k of the states that the peer was made with; matrices row by row.
using StateCall = std::function<void(std::size_t k, double* out)>;

/// Another library on the same robot, by the names of dyngen's functions: id, gravity, mass_matrix,
/// fd. The states are kept in the library's own types, so that a call pays for no conversion.
using Peer = std::map<std::string, StateCall>;

/// @param robot  rigid bodies: no rotor inertia, no friction
Peer make_kdl_peer(const test::NumericRobot& robot, const States& states);
Peer make_mujoco_peer(const test::NumericRobot& robot, const States& states);
Peer make_dart_peer(const test::NumericRobot& robot, const States& states);

}  // namespace dyngen::bench
