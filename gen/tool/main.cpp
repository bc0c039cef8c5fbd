// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gen/algorithms/code_model/code_effects.h"
#include "gen/diagnostic/assert.h"
#include "gen/drawing/arm_drawing.h"
#include "gen/effect_code/checked_robot.h"
#include "gen/evaluate/state_words.h"
#include "gen/explain/explain.h"
#include "gen/generator/generator.h"
#include "gen/model/robot_model.h"
#include "gen/robot_output/robot_tree.h"
#include "gen/tool/fitted_lines.h"
#include "gen/tool/further_outputs.h"
#include "gen/tool/options.h"
#include "gen/tool/output_files.h"
#include "gen/tool/progress_line.h"
#include "gen/tool/wrench_words.h"

namespace dyngen {
namespace {

void print_warnings(const CheckedRobot& robot, const RobotModel& model,
                    const GeneratorOptions& options) {
  Diagnostics diagnostics(robot.file.file_name, robot.file.source_text);
  add_robot_warnings(robot, model, AbsentRows::kZero, diagnostics);
  for (const BoundEffect& effect : bound_effects(model, options)) {
    const std::string reason = why_not_in_controller(*effect.file);
    if (reason.empty()) continue;
    const std::string& name = effect.file->name;
    diagnostics.warning(effect.position, static_cast<int>(name.size()),
                        "effect '" + name + "' cannot run in a controller: " + reason +
                            "; it is left out of the emitted functions");
  }
  std::cerr << diagnostics.render();
}

/// The files that the output depends on.
std::vector<std::string> dependencies(const ToolOptions& options) {
  std::vector<std::string> files = {options.robot.path};
  for (const std::string& folder : options.effect_folders) {
    std::vector<std::string> own;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() == ".effect") own.push_back(entry.path().string());
    }
    std::sort(own.begin(), own.end());
    files.insert(files.end(), own.begin(), own.end());
  }
  return files;
}

void print(const std::string& text) {
  std::cout << text << std::flush;
  if (!std::cout) throw OutputError("standard output: error: cannot write");
}

/// What is asked for does not go with this robot.
bool report_misuse(ToolOptions& options, const RobotModel& model) {
  try {
    GeneratorOptions& generator = options.generator;
    if (generator.wrench) generator.wrench_link = wrench_link(options.wrench, model);
    generator.validate(model);
    if (!options.eval.empty()) read_state(options.eval, model);
    return false;
  } catch (const std::invalid_argument& error) {
    std::cerr << "dyngen: " << error.what() << "\n";
    return true;
  }
}

/// Functions that the robot has not, by the reason.
using Missing = std::map<std::string, std::vector<std::string>>;

/// "arm.robot: warning: fd is left out: ..."
std::string missing_text(const Missing& missing, const std::string& file_name) {
  std::string text;
  for (const auto& [reason, names] : missing) {
    text += file_name + ": warning: ";
    for (const std::string& name : names) text += (&name == &names.front() ? "" : ", ") + name;
    text += (names.size() > 1 ? " are" : " is") + std::string(" left out: ") + reason + "\n";
  }
  return text;
}

/// The options with a line of progress and a list of what is missing, which must outlive them.
GeneratorOptions telling(GeneratorOptions options, ProgressLine& line, Missing& missing) {
  options.progress = [&line](const std::string& name, std::size_t place, std::size_t all) {
    line.show(name, place, all);
  };
  options.left_out = [&missing](const std::string& name, const std::string& reason) {
    std::vector<std::string>& names = missing[reason];
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  return options;
}

/// The files that hold the functions: C, and scripts.
std::vector<OutputFile> function_files(const ToolOptions& tool, const RobotModel& model,
                                       Missing& missing) {
  if (tool.output.empty() && tool.numpy.empty() && tool.matlab.empty()) return {};
  ProgressLine line("dyngen");
  ToolOptions options = tool;
  options.generator = telling(tool.generator, line, missing);
  CodeModel code = make_code_model(model, options.generator);
  const std::vector<RobotFunction> functions = write_functions(code, options.generator);
  std::vector<OutputFile> files;
  if (!options.output.empty()) {
    const CText text = generated_text(model, code, functions, options.generator);
    files = {{options.output, text.source}, {options.header(), text.header}};
    if (options.generator.cpp_wrapper) files.push_back({options.wrapper(), text.wrapper});
    if (!options.depfile.empty()) {
      std::vector<std::string> targets;
      for (const OutputFile& written : files) targets.push_back(written.path);
      files.push_back({options.depfile, depfile_text(targets, dependencies(options))});
    }
  }
  for (OutputFile& script : script_files(options, code, functions)) {
    files.push_back(std::move(script));
  }
  return files;
}

std::string counted(const RobotModel& model, const GeneratorOptions& options, Missing& missing) {
  CodeModel code = make_code_model(model, options);
  ProgressLine line("dyngen");
  return count_table(code, write_functions(code, telling(options, line, missing)));
}

/// The text; what was left out of it is printed.
std::string told(WrittenRobot written, const RobotFile& file) {
  Diagnostics diagnostics(file.file_name, file.source_text);
  for (const Diagnostic& own : written.warnings) {
    diagnostics.warning(own.position, own.length, own.message, own.hint);
  }
  std::cerr << diagnostics.render();
  return std::move(written.text);
}

int run(ToolOptions options) {
  const CheckedRobot robot = read_checked_robot(options.robot, options.effect_folders);
  const RobotModel model = build_model(robot.file);
  if (report_misuse(options, model)) return kUsage;
  options.generator.catalogue = robot.catalogue;
  print_warnings(robot, model, options.generator);
  Missing missing;
  std::vector<OutputFile> files = function_files(options, model, missing);
  if (!options.latex.empty()) files.push_back(latex_file(options, model));
  if (!options.drawing.empty()) files.push_back({options.drawing, arm_drawing(model)});
  if (!options.to_robot.empty()) files.push_back({options.to_robot, robot.file.text});
  if (!options.to_urdf.empty()) {
    files.push_back({options.to_urdf, told(urdf_text(robot.file, model), robot.file)});
  }
  if (!options.to_mjcf.empty()) {
    files.push_back({options.to_mjcf, told(mjcf_text(robot.file, model), robot.file)});
  }
  write_files(files);
  if (options.explain) print(explain(model));
  if (!options.eval.empty()) print(evaluated(options, model, robot.file));
  if (!options.compare.empty()) print(compared(options, model, robot.file));
  if (options.count) print(counted(model, options.generator, missing));
  std::cerr << missing_text(missing, options.robot.path);
  return kDone;
}

int guarded_main(int argc, const char* const* argv) {
  const ParsedOptions parsed = parse_options(argc, argv);
  if (parsed.exit_code >= 0) return parsed.exit_code;
  try {
    return run(parsed.options);
  } catch (const ModelError& error) {
    std::cerr << error.what();
    return kInputWrong;
  } catch (const OutputError& error) {
    std::cerr << error.what() << "\n";
    return kInputWrong;
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << "dyngen: error: " << error.what() << "\n";
    return kInputWrong;
  } catch (const std::exception& error) {
    std::cerr << "dyngen: internal error: " << error.what()
              << "\nThis is a bug of dyngen. Please report it with the file "
              << parsed.options.robot.path << ".\n";
    return kOurBug;
  }
}

}  // namespace
}  // namespace dyngen

int main(int argc, char** argv) {
  const dyngen::FittedLines out(std::cout), errors(std::cerr);
  return dyngen::guarded_main(argc, argv);
}
