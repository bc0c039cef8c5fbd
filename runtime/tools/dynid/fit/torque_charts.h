// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/tools/dynid/fit/fit_report.h"

namespace dyngen::runtime {

/// Torque of each joint over time as it was recorded and as the model says, and what is left: a
/// chart a joint, a view a run, held-out ones first. Both sides stand behind the filters of the
/// fit; of a robot with effects, these are taken off. Empty where samples are not in memory.
/// Evaluates the equations once more.
std::vector<ReportChart> torque_charts(const FitReport& report);

}  // namespace dyngen::runtime
