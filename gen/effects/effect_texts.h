// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string_view>
#include <vector>

namespace dyngen {

/// A file of this folder, as the build put it into the program.
struct EffectSource {
  std::string_view file_name;  ///< "stribeck.effect"
  std::string_view text;
};

/// All files *.effect of this folder, in the order of their names.
const std::vector<EffectSource>& effect_texts();

}  // namespace dyngen
