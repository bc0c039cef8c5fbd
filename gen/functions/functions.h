// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/functions/catalogue.h"
#include "gen/passes/search.h"

namespace dyngen {

/// A function of one robot.
struct RobotFunction {
  const FunctionSpec* spec = nullptr;
  std::string name;  ///< without the prefix: "fk_3"
  Trace trace;
  bool scalar = true;  ///< is to be emitted for one sample
  bool batch = false;  ///< is to be emitted for many samples
};

/// Writes a function of the robot as its algorithm does; what the outputs do not need is gone.
RobotFunction write_plain_function(const FunctionName& name, const CodeModel& code);

/// Writes a function of the robot with as few operations as the passes find.
/// @param name  of the catalogue, and of a link that the robot has
RobotFunction write_function(const FunctionName& name, const CodeModel& code,
                             const SearchOptions& options = {});

/// Writes functions that read the array "folded" in place of "chi", and behind them the function
/// fold that computes it: what depends on parameters alone is worked out once for each change of
/// them.
/// @param code  of the option fold, with chi; gets the names of folded
std::vector<RobotFunction> write_folded_functions(const std::vector<FunctionName>& names,
                                                  CodeModel& code,
                                                  const SearchOptions& options = {});

}  // namespace dyngen
