// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/options/effects_options.h"

#include <CLI/CLI.hpp>

namespace dyngen::runtime {

void add_effects(CLI::App& tool, EffectsOptions& options) {
  CLI::App* effects =
      tool.add_subcommand("effects", "the physical effects that a robot file may have");
  effects->add_option("name", options.name, "tell of this effect; default: a list of all");
  effects->add_option("--markdown", options.markdown, "write the document of all effects");
  effects->add_option("--figures", options.figures,
                      "draw its pictures into this folder (needs gnuplot)");
  effects->add_option("--effects", options.folders, "a folder of effects of your own")
      ->allow_extra_args(false);
}

}  // namespace dyngen::runtime
