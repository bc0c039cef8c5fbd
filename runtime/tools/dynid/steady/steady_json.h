// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/tools/dynid/robot/json_numbers.h"
#include "runtime/tools/dynid/steady/steady_report.h"

namespace dyngen::runtime {

/// The array `steady` of docs/reference/diagnosis.md.
Json steady_json(const SteadyJoints& steady);

}  // namespace dyngen::runtime
