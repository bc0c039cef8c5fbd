// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Writes the pose in frame 0 of the file's frame of a link as the output "T": 4 x 4, row-major,
/// the last column in m.
///
/// Axes go from the base to the tip. The origin goes from some link on the way to the base, vector
/// by vector, and from that link to the tip along the axes; the link is the one that costs least.
void write_pose(Trace& trace, const CodeModel& code, int link);

}  // namespace dyngen
