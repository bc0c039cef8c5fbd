// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace dyngen::runtime {

/// Where a command writes its results for people to look at.
struct PageOptions {
  std::string report;   ///< the page; empty: none
  std::string figures;  ///< folder of its figures; empty: none
  std::string command;  ///< as it was called, for the page
};

/// Adds --report and --figures.
void add_page_options(CLI::App& command, PageOptions& options);

/// The words of a call as a shell would need them, the program's path left out.
std::string command_text(int argc, const char* const* argv);

}  // namespace dyngen::runtime
