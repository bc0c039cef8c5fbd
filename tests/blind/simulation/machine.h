// SPDX-License-Identifier: MIT
// One copy of an arm: its bodies, its drives, and the plant that they make.
#pragma once

#include "tests/blind/simulation/plant.h"
#include "tests/blind/simulation/random.h"

namespace blind {

struct Machine {
  Arm arm;
  Tree tree;                                           ///< with inertias
  Eigen::VectorXd armature, coulomb, viscous, offset;  ///< (j)

  Eigen::Index joints() const { return arm.joints(); }
};

using MakeEngine = Engine (*)(const Tree& tree);

/// Bodies of point masses in boxes of the arm's sizes; drives within 40 % of the arm's.
Machine draw_machine(const Arm& arm, Random random);

/// The same machine with every number wrong by up to 20 %.
Machine mistaken(const Machine& machine, Random random);

/// Index of the link of a joint (from 0): links that were put in stand between them.
int link_of(const Tree& tree, Eigen::Index joint);

/// Puts a link behind `after`; what `after` carried is carried by it where it takes the children.
int insert_link(Tree& tree, int after, const Link& link, bool takes_children);

/// Bodies and drives; the tree may hold more links than the machine's.
Plant assemble(const Machine& machine, const Tree& tree, MakeEngine make);

/// Effective inertia of each joint in the middle of its range, (j) kg m^2.
Eigen::VectorXd middle_inertia(const Machine& machine, const Engine& engine);

}  // namespace blind
