// SPDX-License-Identifier: MIT
#include "tests/peers/peer.h"

namespace dyngen::test {

std::vector<PeerKind> peer_kinds() {
  return {
#ifdef DYNGEN_PEER_MUJOCO
      {"Mujoco", true, make_mujoco_peer},
#endif
#ifdef DYNGEN_PEER_KDL
      {"KdlChain", false, make_kdl_chain_peer},
      {"KdlTree", true, make_kdl_tree_peer},
#endif
#ifdef DYNGEN_PEER_DART
      {"Dart", true, make_dart_peer},
#endif
  };
}

}  // namespace dyngen::test
