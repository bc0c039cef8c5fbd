// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/effects/effect_recordings.h"
#include "runtime/tools/dynid/described_robot.h"

namespace dyngen::runtime {

/// Derivatives of the rigid model that effects read.
/// @param robot    must outlive it
/// @param effects  whose variables are wanted
EffectRobot effect_robot(const DescribedRobot& robot, const std::vector<EffectInstance>& effects);

}  // namespace dyngen::runtime
