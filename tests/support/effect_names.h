// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/effects/effect_texts.h"

namespace dyngen::test {

/// Names of all effects of the catalogue, from the names of their files. Nothing is parsed: a
/// program that instantiates tests by these names asks for them whenever it starts.
inline std::vector<std::string> effect_names() {
  std::vector<std::string> names;
  for (const EffectSource& source : effect_texts()) {
    names.emplace_back(source.file_name.substr(0, source.file_name.rfind('.')));
  }
  return names;
}

}  // namespace dyngen::test
