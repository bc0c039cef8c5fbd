// SPDX-License-Identifier: MIT
// Many effects at once, as arms have them.
#pragma once

#include "tests/blind/truths/truth.h"

namespace blind {

/// Pre-sliding or Stribeck friction on every joint; bent viscous friction, load friction where
/// gravity pulls, cogging, a coupling, a cable and heat as they come: 5 to 12 in all. No family is
/// twice on a joint.
std::vector<Truth> draw_crowd(const Machine& machine, const Schedule& schedule, Random random);

}  // namespace blind
