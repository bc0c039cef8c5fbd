// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/tool/progress_line.h"
#include "runtime/identification/motion_source.h"
#include "runtime/identification/summary.h"
#include "runtime/model/linear_model.h"
#include "runtime/recordings/trajectory_file.h"
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
  double row_time = 0;        ///< s
  Eigen::VectorXd equations;  ///< (n) that each joint has; empty: not counted
  RecordingCondition condition;
};

/// Recordings of the command line with what was made of them.
struct LoadedRecordings {
  std::vector<MotionSource> sources;
  std::vector<RecordingLine> lines;
  std::vector<std::string> left_out;  ///< why a file holds too little, in a sentence for each
};

/// What was repaired in a recording: printed to standard error when it goes out of scope, also
/// where reading the recording or what follows fails.
class ToldRepairs {
 public:
  ToldRepairs() = default;
  ~ToldRepairs();
  ToldRepairs(const ToldRepairs&) = delete;
  ToldRepairs& operator=(const ToldRepairs&) = delete;
  std::vector<Notice> notices;
};

/// A motion that was commanded or is planned: motion_input() with its repairs told.
Trajectory load_motion(const std::string& path, const std::string& map, const RobotSource& robot);

/// What of the robot file a fit asks about.
OpenParameters opened_by(const ToolOptions& options);

/// Reads all; repairs, and which files are left out, are printed to standard error.
/// @throws TooLittleDataError  if recordings that are fitted are all left out
LoadedRecordings load_recordings(const std::vector<std::string>& paths, const ToolOptions& options,
                                 bool heldout, ProgressLine& progress);

LoadedRecordings load_recordings(const std::vector<RecordingInput>& inputs,
                                 const ToolOptions& options, bool heldout, ProgressLine& progress);

/// One cut-off for all: chosen from those that are fitted, with the model where there is one
/// (common_cutoff()), else by their spectra alone.
void settle_cutoff(const LinearModel* model, LoadedRecordings& fitted, LoadedRecordings& heldout,
                   const ToolOptions& options, ProgressLine& progress);

/// The line of a source.
RecordingLine describe(const MotionSource& source, const ToolOptions& options, bool heldout);

/// The equations of all sources, with a line of progress.
std::vector<RowSource> rows_of_all(const LinearModel& model,
                                   const std::vector<MotionSource>& sources,
                                   const ToolOptions& options);

/// A summary of several recordings whose noise is taken at the fit to all of them.
/// @param loaded  learns how many equations each recording has
/// @throws TooLittleDataError  if there are none
RecordingSummary summarise_together(const LinearModel& model, LoadedRecordings& loaded,
                                    const ToolOptions& options, ProgressLine& progress);

/// Equations of held-out recordings. @param loaded  learns how many each recording has
TorqueFactor heldout_equations(const LinearModel& model, LoadedRecordings& loaded,
                               const ToolOptions& options);

/// How many equations each joint has. @return (n)
Eigen::VectorXd equations_of(const TorqueFactor& factor);

/// Why a recording has no equations, beginning with its name; empty: it has some.
std::string why_no_equations(const RecordingLine& line, const RowOptions& rows);

}  // namespace dyngen::runtime
