// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/input/robot_warnings.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "gen/effect_code/checked_robot.h"
#include "gen/robot_input/robot_input.h"

namespace dyngen::runtime {
namespace {

/// How a command reads its robot files.
struct RobotFiles {
  std::vector<RobotSource> sources;
  AbsentRows absent = AbsentRows::kUnknown;
  bool effects = true;  ///< rows `effect` have a meaning
  std::vector<std::string> folders;
};

RobotFiles robot_files(const ToolOptions& options) {
  RobotFiles files{.sources = {options.robot}, .folders = options.effects};
  switch (options.command) {
    case Command::kMerge:
    case Command::kEffects:
      return {};
    case Command::kSimulate:
      files.sources = {options.simulate.robot, options.simulate.plant};
      files.absent = AbsentRows::kZero;
      files.folders = options.simulate.effects;
      break;
    case Command::kCheck:
      files.absent = AbsentRows::kZero;
      break;
    case Command::kExcite:
      files.effects = !options.excite.findings.empty();
      files.folders = options.excite.effects;
      break;
    case Command::kAccumulate:
      files.effects = false;
      break;
    case Command::kDiagnose:
      files.sources.push_back(options.robot.beside(options.diagnose.controller_model));
      break;
    case Command::kFit:
    case Command::kAtlas:
      break;
  }
  return files;
}

std::string warnings_of(const RobotSource& source, const RobotFiles& files) {
  CheckedRobot robot;
  if (files.effects) {
    robot = read_checked_robot(source, files.folders);
  } else {
    robot.file = read_robot_file(source);
  }
  Diagnostics diagnostics(robot.file.file_name, robot.file.source_text);
  add_robot_warnings(robot, build_model(robot.file), files.absent, diagnostics);
  return diagnostics.render();
}

}  // namespace

std::string robot_warnings(const ToolOptions& options) {
  const RobotFiles files = robot_files(options);
  std::string text;
  std::vector<std::string> seen;
  for (const RobotSource& source : files.sources) {
    const std::string& path = source.path;
    std::error_code ignored;
    // a pipe can be read once, which the command does
    const bool pipe =
        std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored);
    if (pipe && !std::filesystem::is_directory(path, ignored)) continue;
    const std::string file = std::filesystem::weakly_canonical(path, ignored).string();
    if (path.empty() || std::find(seen.begin(), seen.end(), file) != seen.end()) continue;
    seen.push_back(file);
    text += warnings_of(source, files);
  }
  return text;
}

}  // namespace dyngen::runtime
