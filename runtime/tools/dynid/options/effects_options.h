// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dyngen::runtime {

/// The command line of `dynid effects`.
struct EffectsOptions {
  std::string name;                  ///< of one effect; empty: a list of all
  std::string markdown;              ///< the document; empty: none
  std::string figures;               ///< the folder of its pictures; empty: none
  std::vector<std::string> folders;  ///< of a user's own effects
};

/// Adds the subcommand to the command line.
void add_effects(CLI::App& tool, EffectsOptions& options);

}  // namespace dyngen::runtime
