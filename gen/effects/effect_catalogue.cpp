// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/effects/effect_catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "gen/effects/effect_texts.h"

namespace dyngen {
namespace {

namespace fs = std::filesystem;

std::size_t family_place(const EffectFile& effect) {
  const auto& families = effect_families();
  return static_cast<std::size_t>(std::find(families.begin(), families.end(), effect.family) -
                                  families.begin());
}

bool before(const std::shared_ptr<const EffectFile>& a,
            const std::shared_ptr<const EffectFile>& b) {
  const std::size_t first = family_place(*a), second = family_place(*b);
  return first != second ? first < second : a->name < b->name;
}

/// The name of a file says the name of its effect.
void check_stem(const EffectFile& effect, const fs::path& path) {
  if (path.stem().string() == effect.name) return;
  throw ModelError(
      fmt::format("{}: error: the file holds the effect '{}': expected its name to be "
                  "{}.effect\n",
                  path.string(), effect.name, effect.name));
}

}  // namespace

EffectCatalogue::EffectCatalogue() {
  // read once: the texts are always the same
  static const std::vector<std::shared_ptr<const EffectFile>> kOwn = [] {
    std::vector<std::shared_ptr<const EffectFile>> effects;
    for (const EffectSource& source : effect_texts()) {
      EffectFile effect = parse_effect_file(std::string(source.text),
                                            "gen/effects/" + std::string(source.file_name));
      check_stem(effect, effect.file_name);
      effects.push_back(std::make_shared<const EffectFile>(std::move(effect)));
    }
    std::sort(effects.begin(), effects.end(), before);
    return effects;
  }();
  all_ = kOwn;
}

void EffectCatalogue::add(EffectFile file) {
  std::erase_if(all_, [&](const auto& known) { return known->name == file.name; });
  auto added = std::make_shared<const EffectFile>(std::move(file));
  all_.insert(std::upper_bound(all_.begin(), all_.end(), added, before), added);
}

void EffectCatalogue::add_folder(const std::string& folder) {
  std::error_code problem;
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder, problem)) {
    if (entry.path().extension() == ".effect") paths.push_back(entry.path());
  }
  if (problem) {
    throw ModelError(fmt::format("{}: error: the folder of effects cannot be read: {}\n", folder,
                                 problem.message()));
  }
  if (paths.empty()) {
    throw ModelError(fmt::format("{}: error: the folder has no file *.effect\n", folder));
  }
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    EffectFile effect = read_effect_file(path.string());
    check_stem(effect, path);
    add(std::move(effect));
  }
}

std::shared_ptr<const EffectFile> EffectCatalogue::find(const std::string& name) const {
  const auto found =
      std::find_if(all_.begin(), all_.end(), [&](const auto& own) { return own->name == name; });
  return found == all_.end() ? nullptr : *found;
}

std::string EffectCatalogue::names() const {
  std::string text;
  for (const auto& effect : all_) text += (text.empty() ? "" : ", ") + effect->name;
  return text;
}

}  // namespace dyngen
