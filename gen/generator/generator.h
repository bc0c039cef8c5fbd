// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/effect_code/bound_effect.h"
#include "gen/effects/effect_catalogue.h"
#include "gen/emit_c/emit_c.h"
#include "gen/functions/functions.h"
#include "gen/model/robot_model.h"
#include "gen/symbols/symbolic_robot.h"

namespace dyngen {

inline constexpr const char* kAllFunctions = "all";

/// The name of a function that is left out, and why.
using LeftOut = std::function<void(const std::string& name, const std::string& reason)>;

/// What to generate of a robot.
struct GeneratorOptions {
  /// Names of the catalogue, with kBatchEnding or without; empty: all for one sample;
  /// kAllFunctions: all, for one sample and for many.
  std::vector<std::string> functions;
  ParameterMode parameters = ParameterMode::kBaked;
  bool regroup = true;       ///< use base parameters
  bool gravity = false;      ///< gravity is an argument; the file's is ignored
  bool wrench = false;       ///< a wrench on a link is an argument
  int wrench_link = 0;       ///< the link; 0: the last one
  bool payload = false;      ///< the parameters of a body on the last link are an argument
  bool fold = false;         ///< what parameters alone give is worked out in a function of its own
  bool cpp_wrapper = false;  ///< a C++ header too
  Scalar scalar = Scalar::kDouble;
  Trig trig = Trig::kInline;
  SearchOptions search;  ///< how long to look for fewer operations
  Progress progress;     ///< told of each function; may be empty
  LeftOut left_out;      ///< told of each function that the robot has not; may be empty
  std::string prefix;    ///< empty: the robot's name
  bool effects = true;   ///< those of the robot that run in a controller are in the functions
  /// What rows `effect` mean; null: the effects that are part of the program.
  std::shared_ptr<const EffectCatalogue> catalogue;
  std::string header_name;  ///< what the source includes

  /// @throws std::invalid_argument  naming the option, what was found and what was expected
  void validate() const;
  /// The same, and whether the robot has the links that functions are asked for.
  void validate(const RobotModel& model) const;
};

/// The robot's symbols; those of gravity too if it is an argument.
SymbolicRobot make_symbolic(const RobotModel& model, const GeneratorOptions& options);

/// The robot's effects by the catalogue of the options; none if they are not asked for.
/// @throws ModelError  positioned in the robot file
std::vector<BoundEffect> bound_effects(const RobotModel& model, const GeneratorOptions& options);

/// From the checked robot to what the algorithms see. @throws ModelError  as bound_effects()
CodeModel make_code_model(const RobotModel& model, const GeneratorOptions& options);

/// The functions of the options, in the catalogue's order.
/// @throws ModelError  if the robot has no such function (a mass matrix that is always singular)
/// @param code  with the option fold it gets the names of what is folded
std::vector<RobotFunction> write_functions(CodeModel& code, const GeneratorOptions& options);

/// The whole road from the checked robot to C text. @throws std::invalid_argument  as
/// validate()
CText generate(const RobotModel& model, const GeneratorOptions& options);

/// The C text of functions that were written with these options.
CText generated_text(const RobotModel& model, const CodeModel& code,
                     const std::vector<RobotFunction>& functions, const GeneratorOptions& options);

/// Operation counts of the functions beside the general bounds 105n - 92 and 94n - 86
/// (Khalil and Kleinfinger 1987), as a table to read.
std::string count_table(const CodeModel& code, const std::vector<RobotFunction>& functions);

}  // namespace dyngen
