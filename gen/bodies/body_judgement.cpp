// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/bodies/body_judgement.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

namespace dyngen {

namespace {

/// Descriptions round moments to a few digits.
constexpr Real kRoundedMoment = 0.01L;

void warn_of_body(std::vector<Diagnostic>& warnings, const TextPlace& place, std::string message,
                  std::string hint) {
  warnings.push_back(
      {Severity::kWarning, place.position, place.length, std::move(message), std::move(hint)});
}

void judge_body(const Body& body, std::vector<Diagnostic>& warnings) {
  const std::string name = printable(body.name);
  const Real size =
      std::fabs(body.inertia[0][0]) + std::fabs(body.inertia[1][1]) + std::fabs(body.inertia[2][2]);
  if (body.mass < 0) {
    warn_of_body(
        warnings, body.inertial_place,
        fmt::format("the mass of '{}' is negative: {:g}", name, static_cast<double>(body.mass)),
        "expected 0 or more, in kg");
    return;
  }
  if (body.mass == 0 && size > 0) {
    warn_of_body(warnings, body.inertial_place,
                 fmt::format("'{}' has moments of inertia and no mass: no body has them", name),
                 "expected a mass, in kg");
  }
  if (size == 0) return;
  const Vector3 p = principal_moments(body.inertia);
  const bool exists = p[0] >= -kRoundedMoment * size &&
                      p[2] <= (p[0] + p[1]) * (1 + kRoundedMoment) + kRoundedMoment * p[0];
  if (exists) return;
  warn_of_body(
      warnings, body.inertial_place,
      fmt::format("the inertia of '{}' about its centre of mass has the principal moments {:.3g}, "
                  "{:.3g}, {:.3g}: no body has them",
                  name, static_cast<double>(p[0]), static_cast<double>(p[1]),
                  static_cast<double>(p[2])),
      "each is 0 or more and at most the sum of the two others");
}

void judge_joints(const BodyTree& tree, std::vector<Diagnostic>& warnings) {
  // whether a body or one that hangs on it has mass or inertia, or a joint behind it a rotor
  std::vector<char> heavy(tree.bodies.size(), 0);
  for (std::size_t i = 0; i < tree.bodies.size(); ++i) {
    const Body& body = tree.bodies[i];
    heavy[i] = body.mass != 0 ||
               norm(body.inertia[0]) + norm(body.inertia[1]) + norm(body.inertia[2]) != 0;
  }
  bool changed = true;
  while (changed) {
    changed = false;
    for (const TreeJoint& joint : tree.joints) {
      char& parent = heavy[static_cast<std::size_t>(joint.parent)];
      if (parent != 0 || heavy[static_cast<std::size_t>(joint.child)] == 0) continue;
      parent = 1;
      changed = true;
    }
  }
  for (const TreeJoint& joint : tree.joints) {
    if (joint.type == TreeJointType::kFixed) continue;
    if (heavy[static_cast<std::size_t>(joint.child)] != 0 || joint.armature.value_or(0) != 0) {
      continue;
    }
    const Body& child = tree.bodies[static_cast<std::size_t>(joint.child)];
    warn_of_body(
        warnings, joint.place,
        fmt::format("joint '{}' carries neither mass nor inertia: '{}' and what hangs on it have "
                    "none",
                    printable(joint.name), printable(child.name)),
        "no such torque is in the model");
  }
}

}  // namespace

void judge_bodies(const BodyTree& tree, std::vector<Diagnostic>& warnings) {
  for (const Body& body : tree.bodies) judge_body(body, warnings);
  judge_joints(tree, warnings);
}

}  // namespace dyngen
