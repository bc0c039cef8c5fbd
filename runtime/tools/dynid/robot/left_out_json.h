// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/tools/dynid/robot/identified_description.h"
#include "runtime/tools/dynid/robot/json_numbers.h"

namespace dyngen::runtime {

/// Key "written_back" of a report: the file, what it was made of, and the torque that its form has
/// no field for. docs/reference/robots_in_and_out.md has the keys.
Json written_back_json(const WrittenBack& made);

}  // namespace dyngen::runtime
