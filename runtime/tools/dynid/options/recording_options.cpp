// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/options/recording_options.h"

#include <CLI/CLI.hpp>

namespace dyngen::runtime {

void add_map(CLI::App& command, std::string& map) {
  command.add_option("--map", map,
                     "YAML file that makes recordings and motions of logs as they are (see 'dynid "
                     "import'); a folder stands for the files in it");
}

void add_as_recorded(CLI::App& command, bool& as_recorded) {
  command.add_flag("--as-recorded", as_recorded,
                   "believe recordings that cannot be meant (units, signs, columns)");
}

}  // namespace dyngen::runtime
