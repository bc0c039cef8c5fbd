// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/effect_file/effect_file.h"

namespace dyngen::runtime {

/// The equations of an effect as its file says them, a line each: what it names, what it remembers,
/// its torque.
std::vector<std::string> equation_lines(const EffectFile& effect);

/// The same in one line, torque first: "(Fs - Fc)*fall*sign(qd) where fall = ...".
std::string effect_formula(const EffectFile& effect);

}  // namespace dyngen::runtime
