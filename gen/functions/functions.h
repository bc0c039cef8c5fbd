// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gen/algorithms/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// A function that dyngen can write: the one place that knows its name, inputs and meaning.
struct FunctionSpec {
  std::string_view name;                 ///< without the prefix
  std::vector<std::string_view> inputs;  ///< "q", "dq", "ddq", each with one value per coordinate
  std::string_view output;               ///< "tau", one value per coordinate
  std::string_view summary;
  void (*write)(Trace&, const CodeModel&);
};

/// All functions, in the order in which they are emitted.
const std::vector<FunctionSpec>& function_catalogue();

/// @return null if there is none of this name
const FunctionSpec* find_function(std::string_view name);

/// A function of one robot.
struct RobotFunction {
  const FunctionSpec* spec = nullptr;
  Trace trace;
};

/// Writes a function of the robot; what the outputs do not need is gone.
RobotFunction write_function(const FunctionSpec& spec, const CodeModel& code);

}  // namespace dyngen
