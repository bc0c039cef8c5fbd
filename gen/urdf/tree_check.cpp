// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/urdf/tree_check.h"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

namespace dyngen {
namespace {

void check_no_loop(const BodyTree& tree, const std::vector<const TreeJoint*>& carrier,
                   Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < carrier.size(); ++i) {
    std::size_t body = i;
    for (std::size_t step = 0; step <= carrier.size() && carrier[body] != nullptr; ++step) {
      body = static_cast<std::size_t>(carrier[body]->parent);
    }
    if (carrier[body] == nullptr) continue;
    const TreeJoint& joint = *carrier[i];
    diagnostics.error(joint.place.position, joint.place.length,
                      fmt::format("joint '{}' is part of a loop: link '{}' hangs on itself",
                                  printable(joint.name), printable(tree.bodies[i].name)),
                      "expected a tree");
    return;
  }
}

}  // namespace

void check_is_tree(const BodyTree& tree, Diagnostics& diagnostics) {
  std::vector<const TreeJoint*> carrier(tree.bodies.size(), nullptr);
  for (const TreeJoint& joint : tree.joints) {
    const TreeJoint*& own = carrier[static_cast<std::size_t>(joint.child)];
    const TreeBody& body = tree.bodies[static_cast<std::size_t>(joint.child)];
    if (own != nullptr) {
      diagnostics.error(
          joint.place.position, joint.place.length,
          fmt::format("link '{}' is the child of joint '{}' and of joint '{}'",
                      printable(body.name), printable(own->name), printable(joint.name)),
          "a link has one parent: closed loops are not modelled");
      continue;
    }
    own = &joint;
  }
  if (diagnostics.has_errors()) return;
  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < carrier.size(); ++i) {
    if (carrier[i] == nullptr) roots.push_back(i);
  }
  if (roots.empty()) {
    diagnostics.error(tree.place.position, tree.place.length,
                      "the robot has no root: its links hang on each other in a loop",
                      "expected one link that is no joint's child");
    return;
  }
  if (roots.size() > 1) {
    const TreeBody& second = tree.bodies[roots[1]];
    diagnostics.error(
        second.place.position, second.place.length,
        fmt::format("the robot has {} roots: links '{}' and '{}' hang on no joint", roots.size(),
                    printable(tree.bodies[roots[0]].name), printable(second.name)),
        "join them by fixed joints");
    return;
  }
  check_no_loop(tree, carrier, diagnostics);
}

}  // namespace dyngen
