// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace dyngen {

/// What is wrong with a command line that CLI11 has refused: a command or an option that is not
/// known comes first, with the one that was probably meant; else what CLI11 says.
/// @param refused  its words
std::string usage_message(const CLI::App& tool, int argc, const char* const* argv,
                          const std::string& refused);

}  // namespace dyngen
