// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "gen/tool/output_files.h"
#include "gen/tool/progress_line.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/effects_document.h"
#include "runtime/tools/dynid/options/commands.h"

namespace dyngen::runtime {

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
