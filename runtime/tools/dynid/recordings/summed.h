// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/tool/progress_line.h"
#include "runtime/identification/summary.h"
#include "runtime/tools/dynid/options/options.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// Adds the equations of recordings to a sum, with one recording in memory at a time. What is
/// repaired, what is doubtful and what is left out is printed to standard error.
/// @return  whether any of them has equations
bool add_recordings_to(RecordingSummary& sum, const DescribedRobot& robot,
                       const std::vector<std::string>& paths, const ToolOptions& options,
                       ProgressLine& progress);

}  // namespace dyngen::runtime
