// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/diagnostic/diagnostic.h"
#include "gen/robot_file/robot_file.h"

namespace dyngen {

/// Reads all rows of a text: which rows stand, with how many values, and what each value is.
///
/// What the values mean is check_values()'s matter. After a mistake the reader goes on where the
/// next row begins. If diagnostics has errors afterwards, the result is incomplete; it is still fit
/// for check_values().
RobotFile read_rows(std::string text, std::string file_name, Diagnostics& diagnostics);

}  // namespace dyngen
