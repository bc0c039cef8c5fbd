// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace dyngen::runtime {

/// --map, of every command that reads recordings or motions.
void add_map(CLI::App& command, std::string& map);
/// --as-recorded, of every command that judges recordings.
void add_as_recorded(CLI::App& command, bool& as_recorded);

}  // namespace dyngen::runtime
