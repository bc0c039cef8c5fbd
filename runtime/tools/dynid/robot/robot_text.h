// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gen/robot_file/robot_file.h"

namespace dyngen::runtime {

/// What changes in the text of a robot file; all other rows and comments stay.
struct RobotTextChange {
  /// Rows that are taken out; empty: none.
  std::function<bool(const RowText& row)> removed{};
  /// Rows that take the places of the rows `effect`, one for each; empty: those stay.
  std::vector<std::string> effects{};
  /// Lines that stand where the last row of values was taken out, else at the end of the file.
  std::vector<std::string> added{};
};

/// The text of a robot file that was read, with changes: rows that share a line and rows of several
/// lines are told apart, and a `let` row whose name no row uses any more is taken out too.
std::string changed_text(const RobotFile& file, const RobotTextChange& change);

}  // namespace dyngen::runtime
