// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "gen/tool/output_files.h"
#include "gen/tool/progress_line.h"
#include "runtime/tools/dynid/commands.h"
#include "runtime/tools/dynid/effect_laws.h"
#include "runtime/tools/dynid/effects_document.h"

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

int run_effects(const EffectsOptions& options) {
  const EffectCatalogue catalogue = effect_catalogue(options.folders);
  if (!options.name.empty()) {
    const auto effect = catalogue.find(options.name);
    if (!effect) {
      throw std::invalid_argument(
          fmt::format("there is no effect '{}'; 'dynid effects' lists them", options.name));
    }
    std::cout << effect_text(*effect);
    return kDone;
  }
  if (options.markdown.empty() && options.figures.empty()) {
    std::cout << effects_list(catalogue);
    return kDone;
  }
  const std::string folder =
      options.figures.empty() ? "" : std::filesystem::path(options.figures).filename().string();
  if (!options.figures.empty()) {
    ProgressLine progress("dynid");
    std::filesystem::create_directories(options.figures);
    const std::vector<FamilyFigure> figures = family_figures(catalogue);
    for (std::size_t i = 0; i < figures.size(); ++i) {
      progress.show(figures[i].family, i, figures.size());
      draw(figures[i].figure, options.figures + "/" + figures[i].family + ".svg");
    }
    progress.clear();
  }
  if (!options.markdown.empty()) {
    write_files({{options.markdown, effects_markdown(catalogue, folder)}});
    std::cout << "written: " << options.markdown << "\n";
  }
  return kDone;
}

}  // namespace dyngen::runtime
