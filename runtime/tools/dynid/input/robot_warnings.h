// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "runtime/tools/dynid/options/options.h"

namespace dyngen::runtime {

/// What is doubtful in the robot files of a call, as dyngen says it, with place and hint.
/// @throws ModelError  if one is wrong: everything that is wrong in it, its rows `effect` included
std::string robot_warnings(const ToolOptions& options);

}  // namespace dyngen::runtime
