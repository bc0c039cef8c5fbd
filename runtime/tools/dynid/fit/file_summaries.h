// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/tool/progress_line.h"
#include "runtime/identification/summary.h"
#include "runtime/tools/dynid/options/options.h"
#include "runtime/tools/dynid/process/process_group.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// Many files, each summed up by itself.
struct FileSummaries {
  RecordingSummary sum;               ///< merged in the order of the files
  std::vector<std::string> left_out;  ///< files that could not be used
  std::vector<std::string> notes;     ///< of robots with different names; of what was left out
};

/// Sums up recordings and .qr files, file i in process i mod size(). What it finds has the same
/// bits for any number of processes, and its memory does not grow with the number of files. A file
/// that cannot be used is reported on standard error and left out.
///
/// To be called in process 0; the others serve().
/// @throws std::invalid_argument  if another process does not read the same robot file, or no file
/// can be used
FileSummaries summarise_files(const DescribedRobot& robot, const ToolOptions& options,
                              ProcessGroup& group, ProgressLine& progress);

/// Does what process 0 asks for until it sends everybody home. @return the exit code
int serve(const ToolOptions& options, ProcessGroup& group);

/// Sends all other processes home. @param code  that they return
void dismiss(ProcessGroup& group, int code);

}  // namespace dyngen::runtime
