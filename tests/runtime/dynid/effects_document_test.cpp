// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/effects_document.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace dyngen::runtime {
namespace {

std::string text_of_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST(EffectsDocument, IsWhatTheEffectFilesSay) {
  const EffectCatalogue catalogue;
  EXPECT_TRUE(text_of_file(std::string(DYNGEN_SOURCE_DIR "/docs/reference/effects.md")) ==
              effects_markdown(catalogue, "effects"))
      << "run: dynid effects --markdown docs/reference/effects.md --figures docs/reference/effects";
}

TEST(EffectsDocument, HasAPictureOfEveryFamily) {
  const EffectCatalogue catalogue;
  for (const FamilyFigure& own : family_figures(catalogue)) {
    EXPECT_TRUE(std::filesystem::exists(std::string(DYNGEN_SOURCE_DIR "/docs/reference/effects/") +
                                        own.family + ".svg"))
        << own.family;
    for (const Panel& panel : own.figure.panels) {
      for (const Series& series : panel.series) {
        EXPECT_TRUE(series.y.allFinite()) << series.name;
        EXPECT_GT(series.y.cwiseAbs().maxCoeff(), 0) << series.name;
      }
    }
  }
}

TEST(EffectsDocument, TellsOfOneEffect) {
  const EffectCatalogue catalogue;
  const std::string text = effect_text(*catalogue.find("lugre"));
  EXPECT_NE(text.find("dz/dt = slip"), std::string::npos) << text;
  EXPECT_NE(text.find("emitted by dyngen"), std::string::npos);
}

}  // namespace
}  // namespace dyngen::runtime
