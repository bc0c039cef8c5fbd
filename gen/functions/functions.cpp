// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/functions/functions.h"

#include <utility>

#include "gen/diagnostic/assert.h"
#include "gen/passes/fold.h"
#include "gen/passes/optimise.h"
#include "gen/passes/schedule.h"

namespace dyngen {
namespace {

/// With as few operations as the passes find, in the order that compilers like.
Trace finished(const Trace& plain, const SearchOptions& options) {
  Trace trace = optimised(plain, options);
  trace.drop_dead_code();  // what cancels leaves sines behind
  return scheduled(trace);
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

RobotFunction write_function(const FunctionName& name, const CodeModel& code,
                             const SearchOptions& options) {
  RobotFunction function = write_plain_function(name, code);
  function.trace = finished(function.trace, options);
  return function;
}

std::vector<RobotFunction> write_folded_functions(const std::vector<FunctionName>& names,
                                                  CodeModel& code, const SearchOptions& options) {
  DYNGEN_ASSERT(code.folds(), "the functions read chi");
  std::vector<RobotFunction> functions;
  std::vector<Trace> plain;
  for (const FunctionName& name : names) {
    functions.push_back(write_plain_function(name, code));
    plain.push_back(functions.back().trace);
  }
  FoldedFunctions folded = fold_parameters(plain, code.inputs, options);
  code.folded = std::move(folded.names);
  for (std::size_t i = 0; i < functions.size(); ++i) {
    functions[i].trace = finished(folded.functions[i], options);
  }
  functions.push_back({.spec = &fold_spec(), .name = "fold", .trace = std::move(folded.fold)});
  return functions;
}

}  // namespace dyngen
