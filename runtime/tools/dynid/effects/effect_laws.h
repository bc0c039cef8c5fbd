// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/effect_code/bound_effect.h"
#include "gen/effects/effect_catalogue.h"
#include "runtime/effects/effect_law.h"

namespace dyngen::runtime {

/// An effect file as estimation and simulation see it.
EffectLaw effect_law(const EffectFile& effect);

/// The laws of a whole catalogue, in its order.
std::vector<EffectLaw> effect_laws(const EffectCatalogue& catalogue);

/// The program's own effects and those of the folders --effects.
/// @throws ModelError  if a folder cannot be read or a file is wrong
EffectCatalogue effect_catalogue(const std::vector<std::string>& folders);

/// The rows `effect` of a robot. joint and other are coordinates, from 0; of a force on a link
/// that does not move by itself, `link` tells it alone.
/// @throws ModelError  positioned
std::vector<EffectInstance> effect_instances(const RobotModel& model,
                                             const EffectCatalogue& catalogue);

}  // namespace dyngen::runtime
