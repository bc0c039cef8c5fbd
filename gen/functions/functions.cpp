// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/functions/functions.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "gen/diagnostic/assert.h"
#include "gen/passes/fold.h"
#include "gen/passes/optimise.h"
#include "gen/passes/schedule.h"
#include "gen/program/program.h"

namespace dyngen {
namespace {

/// With as few operations as the passes find, in the order that compilers like.
Trace finished(const Trace& plain, const SearchOptions& options) {
  Trace trace = optimised(plain, options);
  trace.drop_dead_code();  // what cancels leaves sines behind
  return scheduled(trace);
}

std::string output_name(const RobotFunction& function) {
  return std::string(function.spec->outputs[0].array);
}

/// Notes which functions are others under another name: the regressor in base parameters where chi
/// holds nothing else, the derivative by accelerations.
void find_twins(std::vector<RobotFunction>& functions, const CodeModel& code) {
  const auto inputs_of = [&](const RobotFunction& function) {
    std::vector<std::string> names;
    for (const Argument& argument : arguments(*function.spec, code)) {
      if (!argument.output) names.push_back(argument.name);
    }
    return names;
  };
  std::vector<Program> programs;
  for (const RobotFunction& function : functions) programs.push_back(lower(function.trace));
  for (std::size_t i = 0; i < functions.size(); ++i) {
    RobotFunction& function = functions[i];
    if (function.spec->outputs.size() != 1) continue;
    for (std::size_t k = 0; k < i && function.twin.empty(); ++k) {
      const RobotFunction& other = functions[k];
      const bool same = other.twin.empty() && other.spec->outputs.size() == 1 &&
                        inputs_of(other) == inputs_of(function) &&
                        same_steps(programs[k], programs[i]);
      if (same) function.twin = other.name;
    }
  }
}

}  // namespace

RobotFunction write_plain_function(const FunctionName& name, const CodeModel& code) {
  const FunctionSpec& spec = *name.spec;
  DYNGEN_ASSERT(name.link <= code.size(), name.text());
  RobotFunction function{.spec = &spec, .name = name.text(), .trace = Trace(&code.inputs)};
  CodeModel named = code;
  named.links = with_named_parameters(function.trace, code);
  if (spec.of_link()) {
    spec.write_of_link(function.trace, named, name.link > 0 ? name.link : code.size());
  } else {
    spec.write(function.trace, named);
  }
  function.trace.drop_dead_code();
  return function;
}

std::vector<RobotFunction> write_functions(const std::vector<FunctionName>& names, CodeModel& code,
                                           const SearchOptions& options, const Progress& progress) {
  std::vector<RobotFunction> functions;
  for (const FunctionName& name : names) functions.push_back(write_plain_function(name, code));
  find_twins(functions, code);
  std::optional<Trace> fold;
  if (code.folds()) {
    std::vector<Trace> plain;
    for (RobotFunction& function : functions) plain.push_back(std::move(function.trace));
    FoldedFunctions folded = fold_parameters(plain, code.inputs, options);
    code.folded = std::move(folded.names);
    fold = std::move(folded.fold);
    for (std::size_t i = 0; i < functions.size(); ++i) {
      functions[i].trace = std::move(folded.functions[i]);
    }
  }
  for (std::size_t i = 0; i < functions.size(); ++i) {
    RobotFunction& function = functions[i];
    if (progress) progress(function.name, i, functions.size());
    if (function.twin.empty()) {
      function.trace = finished(function.trace, options);
      continue;
    }
    const RobotFunction& twin =
        *std::find_if(functions.begin(), functions.end(),
                      [&](const RobotFunction& other) { return other.name == function.twin; });
    function.trace = twin.trace;
    function.trace.rename_output(output_name(twin), output_name(function));
  }
  if (fold) functions.push_back({.spec = &fold_spec(), .name = "fold", .trace = std::move(*fold)});
  return functions;
}

}  // namespace dyngen
