// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gen/diagnostic/diagnostic.h"

namespace dyngen {

/// A value of an assignment: an expression, blanks left out.
struct ParValue {
  std::string text;
  SourcePosition position;
  int length = 1;  ///< characters as written
};

/// NAME = value, or NAME = {value, ...}
struct ParAssignment {
  std::string name;
  SourcePosition position;
  bool list = false;
  std::vector<ParValue> values;
};

/// All assignments of a text, comments (* *) left out. What is none is reported.
/// @param robot_name  of the comment Robotname = '...', if there is one
std::vector<ParAssignment> read_assignments(std::string_view text, Diagnostics& diagnostics,
                                            std::string& robot_name);

}  // namespace dyngen
