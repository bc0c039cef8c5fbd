// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/effect_file/effect_file.h"

namespace dyngen {

/// Reads the rows of an effect file; what they mean together is not asked here.
EffectFile read_effect_rows(const std::string& text, Diagnostics& diagnostics);

}  // namespace dyngen
