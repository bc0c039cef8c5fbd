// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/effects/effect_catalogue.h"
#include "runtime/plots/figure.h"

namespace dyngen::runtime {

/// A line an effect: name, kind, scope, title.
std::string effects_list(const EffectCatalogue& catalogue);

/// All that the file of an effect says, to read on a terminal.
std::string effect_text(const EffectFile& effect);

/// The document of all effects, family by family, in Markdown.
/// @param figures  folder of the pictures, as the document names it; empty: without pictures
std::string effects_markdown(const EffectCatalogue& catalogue, const std::string& figures);

/// What the effects of a family do to the torque of a pendulum that swings, over the variable that
/// each file names. Members that are drawn over the same variable share a panel.
struct FamilyFigure {
  std::string family;
  Figure figure;
};
std::vector<FamilyFigure> family_figures(const EffectCatalogue& catalogue);

}  // namespace dyngen::runtime
