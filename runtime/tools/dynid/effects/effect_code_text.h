// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "gen/effects/effect_catalogue.h"
#include "gen/robot_file/robot_file.h"
#include "runtime/effects/effect_law.h"

namespace dyngen::runtime {

/// The statements that dyngen writes for an effect: those of the function `friction` in which its
/// name stands, and what reads their results. Empty where the effect does not run in a controller,
/// or the file leaves something open.
/// @param file    of the robot, with rows `effect`    @param row  place of the effect's row, from 0
std::string effect_code_text(const RobotFile& file, std::size_t row, const EffectInstance& effect,
                             const std::shared_ptr<const EffectCatalogue>& catalogue);

/// Why dyngen writes none; empty: it does.
std::string why_no_code(const EffectInstance& effect, const EffectCatalogue& catalogue);

}  // namespace dyngen::runtime
