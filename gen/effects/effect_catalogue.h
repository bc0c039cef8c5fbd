// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gen/effect_file/effect_file.h"

namespace dyngen {

/// Effects by name: those of gen/effects, which are part of the program, and a user's own.
class EffectCatalogue {
 public:
  /// The program's own effects.
  EffectCatalogue();

  /// Adds all files *.effect of a folder, in the order of their names. One of a name that is there
  /// already takes its place.
  /// @throws ModelError  if the folder cannot be read or a file is wrong
  void add_folder(const std::string& folder);

  /// @return null if there is none of this name
  [[nodiscard]] std::shared_ptr<const EffectFile> find(const std::string& name) const;
  /// In the order of the families, then of the names.
  [[nodiscard]] const std::vector<std::shared_ptr<const EffectFile>>& all() const { return all_; }
  /// "cogging, dahl, ...": for messages.
  [[nodiscard]] std::string names() const;

 private:
  void add(EffectFile file);

  std::vector<std::shared_ptr<const EffectFile>> all_;
};

}  // namespace dyngen
