// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/robot_input/robot_source.h"

namespace CLI {
class App;
}

namespace dyngen::runtime {

/// What dynid import is asked for.
struct ImportOptions {
  std::string map;                 ///< YAML; empty with list or guess
  std::vector<std::string> files;  ///< the map first, unless list or guess; then the logs
  std::vector<std::string> logs;
  bool list = false;   ///< say what is in the logs
  bool guess = false;  ///< write a map

  /// Sorts the files into map and logs. @return a message about wrong usage, or nothing
  std::string settle(const std::string& output);
};

/// The command import. Each outlives the tool.
void add_import(CLI::App& tool, RobotSource& robot, std::string& output, ImportOptions& options);

}  // namespace dyngen::runtime
