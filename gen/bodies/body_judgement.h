// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/bodies/body_tree.h"

namespace dyngen {

/// The most bodies that a description may have.
inline constexpr int kMaxBodies = 2000;

/// Warns of masses and inertias that no body has, by the body's name: a negative mass, mass without
/// inertia is a point and passes, moments that are negative or more than the sum of the two others.
/// Warns of joints that move nothing that has mass.
void judge_bodies(const BodyTree& tree, std::vector<Diagnostic>& warnings);

}  // namespace dyngen
