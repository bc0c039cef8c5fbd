// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/write_back.h"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "gen/robot_input/robot_input.h"
#include "gen/tool/output_files.h"
#include "runtime/tools/dynid/effects/effect_laws.h"

namespace dyngen::runtime {

bool is_description_name(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  return ending == ".urdf" || ending == ".xml" || ending == ".mjcf";
}

RobotSource write_back_target(const ToolOptions& options) {
  const bool wanted = is_description_name(options.output);
  if (!wanted) {
    if (options.description.empty()) return {};
    throw std::invalid_argument(fmt::format(
        "--urdf and --mjcf are written to -o: found -o '{}', expected a file .urdf or .xml",
        options.output));
  }
  RobotSource source = options.robot;
  if (!options.description.empty()) source = options.robot.beside(options.description);
  const RobotForm form = robot_form(read_description(source.path));
  if (form != RobotForm::kUrdf && form != RobotForm::kMjcf) {
    throw std::invalid_argument(fmt::format(
        "-o {}: found '{}', which is neither URDF nor MJCF; expected --urdf FILE or --mjcf FILE "
        "that the numbers are written into, or -o FILE.robot",
        options.output, source.path));
  }
  const bool urdf_name = options.output.ends_with(".urdf");
  if (urdf_name != (form == RobotForm::kUrdf)) {
    throw std::invalid_argument(
        fmt::format("-o {}: '{}' is {}; expected an output {}", options.output, source.path,
                    urdf_name ? "MJCF" : "URDF", urdf_name ? ".xml" : ".urdf"));
  }
  return source;
}

void check_write_back(const ToolOptions& options) {
  if (write_back_target(options).empty()) return;
  if (options.own_friction) {
    throw std::invalid_argument(
        "--own-friction writes a file for each robot: expected -o FILE.robot");
  }
  if (options.diagnose.diagnosis.residual_only) {
    throw std::invalid_argument(
        "--residual-only: no numbers of the robot are found; expected -o FILE.robot");
  }
}

WrittenBack made_description(const ToolOptions& options, const std::string& identified,
                             const std::vector<std::string>& comment,
                             const std::vector<MotionSource>& motions) {
  const WriteBackTask task{write_back_target(options), comment, motions, options.rows};
  return {options.output, task.description.path,
          identified_description(identified, options.robot.path, task,
                                 effect_catalogue(options.effects))};
}

void write_description(const WrittenBack& made) {
  write_files({{made.path, made.result.text}});
  std::cout << fmt::format("\n{} is {} with the identified numbers\n", made.path, made.description);
  for (const auto* lines : {&made.result.table, &made.result.notes}) {
    for (const std::string& line : *lines) std::cout << line << "\n";
  }
  std::cout << std::flush;
}

}  // namespace dyngen::runtime
