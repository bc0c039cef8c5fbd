// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/effect_file/effect_file.h"

namespace dyngen {

/// Checks what the rows of an effect file mean together: names, units for revolute and prismatic
/// joints, in which parameters torque is linear, what the kind may read. Fills in `variables`.
void check_effect(EffectFile& effect, Diagnostics& diagnostics);

}  // namespace dyngen
