// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/tool/further_outputs.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "gen/compare/comparison.h"
#include "gen/diagnostic/diagnostic.h"
#include "gen/effect_code/checked_robot.h"
#include "gen/emit_latex/emit_latex.h"
#include "gen/emit_script/emit_matlab.h"
#include "gen/emit_script/emit_numpy.h"
#include "gen/evaluate/evaluation_text.h"

namespace dyngen {
namespace {

constexpr const char* kNoScriptOfStates =
    "effects of this robot remember the call before, which scripts do not";

void tell_of_states(const ToolOptions& options, const CodeModel& code,
                    const std::vector<RobotFunction>& functions) {
  const std::vector<std::string>& asked = options.generator.functions;
  for (const RobotFunction& function : functions) {
    if (!has_state(*function.spec, code)) continue;
    if (std::find(asked.begin(), asked.end(), function.name) != asked.end()) {
      throw ModelError(code.file_name + ": error: --functions: '" + function.name +
                       "': " + kNoScriptOfStates + "\n");
    }
    if (options.generator.left_out) options.generator.left_out(function.name, kNoScriptOfStates);
  }
}

}  // namespace

std::vector<OutputFile> script_files(const ToolOptions& options, const CodeModel& code,
                                     const std::vector<RobotFunction>& functions) {
  std::vector<OutputFile> files;
  if (options.numpy.empty() && options.matlab.empty()) return files;
  tell_of_states(options, code, functions);
  if (!options.numpy.empty()) files.push_back({options.numpy, emit_numpy(code, functions)});
  if (!options.matlab.empty()) {
    const std::string name = std::filesystem::path(options.matlab).stem().string();
    files.push_back({options.matlab, emit_matlab(code, functions, name)});
  }
  return files;
}

OutputFile latex_file(const ToolOptions& options, const RobotModel& model) {
  GeneratorOptions own = options.generator;
  own.functions = {"id"};
  own.parameters = ParameterMode::kRuntime;  // equations show parameters, not their numbers
  own.fold = false;
  CodeModel code = make_code_model(model, own);
  const std::vector<RobotFunction> functions = write_functions(code, own);
  const SymbolicRobot robot = make_symbolic(model);
  return {options.latex,
          emit_latex(model, code, functions.front(), base_formulas(model, robot, regroup(robot)))};
}

std::string evaluated(const ToolOptions& options, const RobotModel& model, const RobotFile& file) {
  const StateRequest state = read_state(options.eval, model);
  RobotNumbers robot(model, options.generator, state.given);
  return evaluation_text(robot, file, state);
}

std::string compared(const ToolOptions& options, const RobotModel& model, const RobotFile& file) {
  CheckedRobot other =
      read_checked_robot(options.robot.beside(options.compare), options.effect_folders);
  GeneratorOptions other_options = options.generator;
  other_options.catalogue = other.catalogue;
  const ComparedRobot first = {model, file, options.generator};
  const ComparedRobot second = {build_model(other.file), other.file, other_options};
  return comparison_text(first, second, compare_robots(first, second));
}

}  // namespace dyngen
