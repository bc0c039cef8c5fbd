// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/bodies/body_tree.h"
#include "gen/mjcf/mjcf_defaults.h"

namespace dyngen {

/// Gives joints that equalities and tendons couple their refusal, and warns of the gears of
/// actuators, which the model leaves out.
void read_mjcf_couplings(const XmlElement& root, const MjcfDefaults& defaults, XmlValues& values,
                         BodyTree& tree);

}  // namespace dyngen
