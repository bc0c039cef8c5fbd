// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/algorithms/mass_matrix/composite_bodies.h"

namespace dyngen {

/// Writes all elements of the mass matrix into a draft: [i][j] of moving links i <= j, by link
/// number; the others stay 0. Rotor inertia is added on the diagonal.
std::vector<std::vector<DraftValue>> draft_mass_elements(Draft& draft, const CompositeRobot& robot,
                                                         const CompositeChoices& choices);

/// Plain choices: every wrench is carried down to the joint that feels it.
CompositeChoices first_choices(const CompositeRobot& robot);

/// The choices with which the mass matrix takes the fewest operations, of those that were tried.
///
/// One choice after another is changed, and kept where the draft gets shorter, until none helps or
/// the work allowed is done; work is counted in statements, so the result is the same on every
/// machine.
CompositeChoices shortest_choices(const DraftLeaves& leaves, const CompositeRobot& robot);

}  // namespace dyngen
