// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/generator/generator.h"
#include "gen/robot_input/robot_source.h"

namespace dyngen {

/// What dyngen exits with.
inline constexpr int kDone = 0, kInputWrong = 1, kUsage = 2, kOurBug = 70;

/// The command line of dyngen.
struct ToolOptions {
  RobotSource robot;
  std::string output;    ///< the C or C++ source; its header stands beside it; empty: none
  std::string depfile;   ///< empty: none
  std::string drawing;   ///< the arm's picture, SVG; empty: none
  std::string to_robot;  ///< the robot file, made or as it is; empty: none
  std::string to_urdf;   ///< empty: none
  std::string to_mjcf;   ///< empty: none
  std::vector<std::string> effect_folders;  ///< in the order of the command line
  bool count = false;
  bool explain = false;
  GeneratorOptions generator;

  /// The header's path: the output's with ".h".
  [[nodiscard]] std::string header() const;
  /// The C++ header's: with ".hpp".
  [[nodiscard]] std::string wrapper() const;
};

/// Reads the command line. @return what to do, or the exit code if there is nothing left to do
///         (kDone after --help or --version, kUsage after a message about wrong usage)
struct ParsedOptions {
  ToolOptions options;
  int exit_code = -1;  ///< -1: go on
};
ParsedOptions parse_options(int argc, const char* const* argv);

}  // namespace dyngen
