// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/tools/dynid/effects/effect_report.h"
#include "runtime/tools/dynid/robot/json_numbers.h"

namespace dyngen::runtime {

/// The part of the JSON about effects.
Json effect_json(const EffectReport& report, const DescribedRobot& robot);

}  // namespace dyngen::runtime
