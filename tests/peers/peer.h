// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/support/numeric_robot.h"

/// Other dynamics libraries as judges of the generated code.
namespace dyngen::test {

/// What a function reads: one value per moving joint, in the robot's order.
struct PeerInput {
  std::vector<double> q, dq, ddq, tau;
  /// Force and moment about O_n that the environment applies to the last link, in its frame.
  std::array<double, 6> wrench{};
  int link = 0;  ///< whose frame fk and jacobian speak of, 1-based; 0: the last link
};

using PeerCall = std::function<std::vector<double>(const PeerInput&)>;

/// A robot in another library. What a library does not know of a joint (friction, perhaps the
/// rotor) is not in its numbers.
struct Peer {
  std::string name;
  bool holds_rotor = false;    ///< IA is in id, mass_matrix and fd
  bool holds_viscous = false;  ///< Fv is in id and fd
  /// By the names and with the meaning of dyngen's functions: id, gravity, coriolis, mass_matrix,
  /// fd, fk, jacobian; matrices row by row. `id` and `fd` take the wrench.
  std::map<std::string, PeerCall> calls;
};

/// How to make a peer of a robot, and what it can take.
struct PeerKind {
  std::string name;
  bool trees = false;  ///< takes robots whose links have several children
  std::function<Peer(const NumericRobot&)> make;
};

/// The libraries that this program was built with.
std::vector<PeerKind> peer_kinds();

Peer make_kdl_chain_peer(const NumericRobot& robot);
Peer make_kdl_tree_peer(const NumericRobot& robot);
Peer make_mujoco_peer(const NumericRobot& robot);
Peer make_dart_peer(const NumericRobot& robot);

}  // namespace dyngen::test
