// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/input/robot_warnings.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "gen/effect_code/checked_robot.h"

namespace dyngen::runtime {
namespace {

/// How a command reads its robot files.
struct RobotFiles {
  std::vector<std::string> paths;
  AbsentRows absent = AbsentRows::kUnknown;
  bool effects = true;  ///< rows `effect` have a meaning
  std::vector<std::string> folders;
};

RobotFiles robot_files(const ToolOptions& options) {
  RobotFiles files{.paths = {options.robot}, .folders = options.effects};
  switch (options.command) {
    case Command::kMerge:
    case Command::kEffects:
      return {};
    case Command::kSimulate:
      files.paths = {options.simulate.robot, options.simulate.plant};
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
      files.paths.push_back(options.diagnose.controller_model);
      break;
    case Command::kImport:
      files.effects = false;
      break;
    case Command::kFit:
    case Command::kAtlas:
      break;
  }
  return files;
}

std::string warnings_of(const std::string& path, const RobotFiles& files) {
  CheckedRobot robot;
  if (files.effects) {
    robot = read_checked_robot(path, files.folders);
  } else {
    robot.file = read_robot_file(path);
  }
  Diagnostics diagnostics(robot.file.file_name, robot.file.text);
  add_robot_warnings(robot, build_model(robot.file), files.absent, diagnostics);
  return diagnostics.render();
}

}  // namespace

std::string robot_warnings(const ToolOptions& options) {
  const RobotFiles files = robot_files(options);
  std::string text;
  std::vector<std::string> seen;
  for (const std::string& path : files.paths) {
    std::error_code ignored;
    // a pipe can be read once, which the command does
    const bool pipe =
        std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored);
    if (pipe && !std::filesystem::is_directory(path, ignored)) continue;
    const std::string file = std::filesystem::weakly_canonical(path, ignored).string();
    if (path.empty() || std::find(seen.begin(), seen.end(), file) != seen.end()) continue;
    seen.push_back(file);
    text += warnings_of(path, files);
  }
  return text;
}

}  // namespace dyngen::runtime
