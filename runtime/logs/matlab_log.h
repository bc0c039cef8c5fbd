// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "runtime/logs/log_bytes.h"
#include "runtime/logs/raw_log.h"

namespace dyngen::runtime {

/// Variables of a MATLAB file, version 5 to 7.3, held in memory. A struct is a table with a column
/// for each field ("pos", "pos[2]", "motor.pos[2]"); variables that are arrays are one table for
/// each length. Samples are along the longer side.
/// @throws LogError; also if this library was built without matio
std::unique_ptr<RawLog> open_matlab(const LogBytes& bytes);

}  // namespace dyngen::runtime
