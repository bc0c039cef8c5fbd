// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/diagnostic/diagnostic.h"
#include "gen/effect_file/effect_file.h"
#include "gen/effect_file/units.h"

namespace dyngen {

/// Reports equations and values of an effect whose units do not fit, on a joint of this kind. Its
/// names are checked already.
void check_effect_units(const EffectFile& effect, JointUnits joint, Diagnostics& diagnostics);

}  // namespace dyngen
