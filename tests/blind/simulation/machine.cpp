// SPDX-License-Identifier: MIT
#include "tests/blind/simulation/machine.h"

#include <stdexcept>

namespace blind {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Six point masses, half of them along the way to the next link.
Inertia draw_inertia(double mass, double size, const Vector3d& next, Random& random) {
  constexpr int kPoints = 6;
  std::vector<Inertia> parts;
  double total = 0;
  for (int i = 0; i < kPoints; ++i) {
    Inertia point;
    point.mass = random.between(0.5, 1.5);
    total += point.mass;
    for (Index k = 0; k < 3; ++k) point.com[k] = random.between(-0.4, 0.4) * size;
    if (i % 2 == 0) point.com += next * random.unit();
    parts.push_back(point);
  }
  for (Inertia& part : parts) part.mass *= mass / total;
  return sum(parts);
}

VectorXd near(const VectorXd& typical, double spread, Random& random) {
  VectorXd result = typical;
  for (double& value : result) value *= random.between(1 - spread, 1 + spread);
  return result;
}

}  // namespace

Machine draw_machine(const Arm& arm, Random random) {
  Machine machine;
  machine.arm = arm;
  machine.tree = arm.tree;
  const VectorXd mass = near(arm.mass, 0.4, random);
  for (Index j = 0; j < arm.joints(); ++j) {
    const auto i = static_cast<std::size_t>(j);
    const Vector3d next = i + 1 < machine.tree.links.size() ? machine.tree.links[i + 1].position
                                                            : Vector3d(0, 0, arm.size[j]);
    machine.tree.links[i].inertia = draw_inertia(mass[j], arm.size[j], next, random);
  }
  machine.armature = near(arm.armature, 0.4, random);
  machine.coulomb = near(arm.coulomb, 0.4, random);
  machine.viscous = near(arm.viscous, 0.4, random);
  machine.offset.resize(arm.joints());
  for (Index j = 0; j < arm.joints(); ++j) {
    machine.offset[j] = random.between(-0.2, 0.2) * machine.coulomb[j];
  }
  return machine;
}

Machine mistaken(const Machine& machine, Random random) {
  Machine other = machine;
  for (Link& link : other.tree.links) {
    const double scale = random.between(0.8, 1.2);
    link.inertia.mass *= scale;
    link.inertia.about_com *= scale;
    link.inertia.com *= random.between(0.9, 1.1);
  }
  other.armature = near(machine.armature, 0.2, random);
  other.coulomb = near(machine.coulomb, 0.2, random);
  return other;
}

int link_of(const Tree& tree, Index joint) {
  const std::string name = "link" + std::to_string(joint + 1);
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    if (tree.links[i].name == name) return static_cast<int>(i);
  }
  throw std::invalid_argument("there is no " + name);
}

int insert_link(Tree& tree, int after, const Link& link, bool takes_children) {
  const int place = after + 1;
  for (Link& other : tree.links) {
    if (other.parent == after && takes_children) {
      other.parent = place;
    } else if (other.parent >= place) {
      ++other.parent;
    }
  }
  tree.links.insert(tree.links.begin() + place, link);
  tree.links[static_cast<std::size_t>(place)].parent = after;
  return place;
}

Plant assemble(const Machine& machine, const Tree& tree, MakeEngine make) {
  Plant plant;
  plant.engine = make(tree);
  plant.links = static_cast<Index>(tree.links.size());
  plant.armature = VectorXd::Zero(plant.links);
  plant.viscous = VectorXd::Zero(plant.links);
  for (Index j = 0; j < machine.joints(); ++j) {
    const Index c = link_of(tree, j);
    plant.drive.push_back(c);
    plant.carried.push_back(c);
    plant.armature[c] = machine.armature[j];
    plant.viscous[c] = machine.viscous[j];
    const double coulomb = machine.coulomb[j];
    plant.friction.push_back(
        {VectorXd::Unit(plant.links, c), [coulomb](const Moment&) { return coulomb; }});
  }
  plant.forces.push_back(
      [drive = plant.carried, offset = machine.offset](const Moment&, VectorXd& force) {
        for (std::size_t j = 0; j < drive.size(); ++j) {
          force[drive[j]] -= offset[static_cast<Index>(j)];
        }
      });
  return plant;
}

VectorXd middle_inertia(const Machine& machine, const Engine& engine) {
  Dynamics dynamics;
  const VectorXd middle = (machine.arm.q_min + machine.arm.q_max) / 2;
  engine.dynamics(middle, VectorXd::Zero(middle.size()), dynamics);
  return dynamics.M.diagonal() + machine.armature;
}

}  // namespace blind
