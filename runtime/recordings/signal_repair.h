// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/recordings/notice.h"
#include "runtime/recordings/recording.h"

namespace dyngen::runtime {

/// Repairs what only a whole column shows, and tells it with the column, the first line and the
/// count: positions wrapped at a turn (unwrap()), single samples that stand off (find_glitches()),
/// columns that are stuck (find_stuck()). Rows that cannot be repaired become gaps: the run is
/// split there, and runs of fewer than kShortestRun samples are left out.
///
/// @throws RecordingError  if more than 5 % of a column are glitches, or more than half of the rows
///         are stuck, or no run is left
void repair_signals(Recording& recording, std::vector<Notice>& notices);

}  // namespace dyngen::runtime
