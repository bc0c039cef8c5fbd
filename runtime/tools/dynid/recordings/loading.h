// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/tool/progress_line.h"
#include "runtime/identification/motion_source.h"
#include "runtime/identification/summary.h"
#include "runtime/model/linear_model.h"
#include "runtime/tools/dynid/options/options.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// A recording, as reports speak of it.
struct RecordingLine {
  std::string name;
  bool heldout = false;
  double seconds = 0;
  double cutoff = 0;  ///< Hz
  std::string cutoff_reason;
  Eigen::Index decimation = 1;
  double row_time = 0;  ///< s
  RecordingCondition condition;
};

/// Recordings of the command line with what was made of them.
struct LoadedRecordings {
  std::vector<MotionSource> sources;
  std::vector<RecordingLine> lines;
};

/// What of the robot file a fit asks about.
OpenParameters opened_by(const ToolOptions& options);

/// Reads all; repairs are printed to standard error.
LoadedRecordings load_recordings(const std::vector<std::string>& paths, const ToolOptions& options,
                                 bool heldout, ProgressLine& progress);

/// The line of a source.
RecordingLine describe(const MotionSource& source, const ToolOptions& options, bool heldout);

/// The equations of all sources, with a line of progress.
std::vector<RowSource> rows_of_all(const LinearModel& model,
                                   const std::vector<MotionSource>& sources,
                                   const ToolOptions& options);

/// A summary of several recordings whose noise is taken at the fit to all of them.
RecordingSummary summarise_together(const LinearModel& model,
                                    const std::vector<MotionSource>& sources,
                                    const ToolOptions& options, ProgressLine& progress);

}  // namespace dyngen::runtime
