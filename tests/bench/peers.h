// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/bench/speed_states.h"
#include "tests/support/numeric_robot.h"

namespace dyngen::bench {

/// A call on state k of the states that the peer was made with; writes the function's output,
/// matrices row by row.
using StateCall = std::function<void(std::size_t k, double* out)>;

/// Another library on the same robot. Rigid bodies only: no rotor inertia, no friction.
/// The states are kept in the library's own types, so that a call pays for no conversion.
struct Peer {
  std::string name;
  /// By dyngen's names: id, gravity, mass_matrix, fd; those that the library has.
  std::map<std::string, StateCall> calls;
};

/// The libraries that this program was built with.
std::vector<Peer> make_peers(const test::NumericRobot& robot, const States& states);

Peer make_kdl_peer(const test::NumericRobot& robot, const States& states);
Peer make_mujoco_peer(const test::NumericRobot& robot, const States& states);
Peer make_dart_peer(const test::NumericRobot& robot, const States& states);

}  // namespace dyngen::bench
