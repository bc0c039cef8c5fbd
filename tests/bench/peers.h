// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "tests/bench/speed_robots.h"
#include "tests/support/numeric_robot.h"

namespace dyngen::bench {

/// A call on state k of the states that the peer was made with; writes one torque per joint.
using StateCall = std::function<void(std::size_t k, double* tau)>;

/// Another library on the same robot. Rigid bodies only: no rotor inertia, no friction.
/// The states are kept in the library's own types, so that a call pays for no conversion.
struct Peer {
  StateCall id;
  StateCall gravity;  ///< empty if it has none of its own
};

Peer make_kdl_peer(const test::NumericRobot& robot, const States& states);
Peer make_mujoco_peer(const test::NumericRobot& robot, const States& states);

}  // namespace dyngen::bench
