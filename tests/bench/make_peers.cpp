// SPDX-License-Identifier: MIT
#include "tests/bench/peers.h"

namespace dyngen::bench {

std::vector<Peer> make_peers([[maybe_unused]] const test::NumericRobot& robot,
                             [[maybe_unused]] const States& states) {
  std::vector<Peer> peers;
#ifdef DYNGEN_BENCH_KDL
  peers.push_back(make_kdl_peer(robot, states));
#endif
#ifdef DYNGEN_BENCH_MUJOCO
  peers.push_back(make_mujoco_peer(robot, states));
#endif
#ifdef DYNGEN_BENCH_DART
  peers.push_back(make_dart_peer(robot, states));
#endif
  return peers;
}

}  // namespace dyngen::bench
