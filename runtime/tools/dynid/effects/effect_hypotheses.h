// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "gen/effects/effect_catalogue.h"
#include "runtime/effects/effect_law.h"
#include "runtime/identification/motion_source.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// Every effect of a catalogue wherever it can be on a robot (atlas_effects()), with the links that
/// the robot file counts. Pairs that the file names in its rows are looked at besides neighbours.
/// Parameters are left empty.
std::vector<EffectInstance> possible_effects(const DescribedRobot& robot,
                                             const EffectCatalogue& catalogue);

/// Those of them that can compete for recordings: with parameters, NaN where they are looked for.
///
/// What is given and never estimated takes the typical number of its file. An effect is left out
/// where there is no such number: it is an expression in sizes of the joint, or the length of a
/// mechanism that no two machines share (a user's own file is believed). So is an effect that reads
/// a temperature which a recording lacks.
std::vector<EffectInstance> competing_effects(const DescribedRobot& robot,
                                              const EffectCatalogue& catalogue,
                                              const std::vector<MotionSource>& recordings);

}  // namespace dyngen::runtime
