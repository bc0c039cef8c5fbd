// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <functional>
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
  std::string twin{};  ///< an earlier function with the same steps into another array
};

/// Writes a function of the robot as its algorithm does; what the outputs do not need is gone.
RobotFunction write_plain_function(const FunctionName& name, const CodeModel& code);

/// Told before each function: its name, its place from 0, how many there are.
using Progress = std::function<void(const std::string& name, std::size_t place, std::size_t all)>;

/// Writes functions of the robot with as few operations as the passes find.
///
/// With the option fold they read the array "folded" in place of "chi", and behind them stands the
/// function fold that computes it: what depends on parameters alone is worked out once for each
/// change of them.
/// @param names  of the catalogue, and of links that the robot has
/// @param code   with the option fold it gets the names of folded
std::vector<RobotFunction> write_functions(const std::vector<FunctionName>& names, CodeModel& code,
                                           const SearchOptions& options = {},
                                           const Progress& progress = {});

}  // namespace dyngen
