// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "gen/tool/progress_line.h"
#include "runtime/excitation/excitation.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/report/document.h"
#include "runtime/tools/dynid/excite/excite_limits.h"
#include "runtime/tools/dynid/excite/excite_values.h"
#include "runtime/tools/dynid/options/options.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// What a motion says of the parameters of interest.
struct MotionWorth {
  double condition = 0;        ///< of the regressor in SI units, all joints alike
  double unit_condition = 0;   ///< with columns of length 1
  Eigen::VectorXd deviations;  ///< (p) of the parameters after all periods, torque noise white
};

/// Everything that `dynid excite` found, and what it was asked.
struct ExciteReport {
  ExciteOptions options;
  DescribedRobot robot;
  MotionLimits limits;
  std::vector<std::string> notes;  ///< what was assumed; a sentence each
  std::vector<int> parameters;     ///< of interest, places in the model
  Eigen::VectorXd noise;           ///< (n) N m, of one sample
  bool prior = false;

  bool found = false;
  std::string message;          ///< why nothing was found, or how the search ended
  Trajectory trajectory;        ///< all periods
  int samples = 0;              ///< of one period
  int periods = kUsualPeriods;  ///< that are written
  double duration = 0;          ///< s, of one period
  bool repeats = true;          ///< a multistage trajectory does not come back to its start
  LimitShares shares;           ///< at kCheckRate
  MotionWorth worth, random;    ///< of the result and of the first random trajectory
  std::vector<ExcitationStart> starts;
  int evaluations = 0;
};

/// Hz, at which limits must be kept.
inline constexpr double kCheckRate = 10000;

/// @throws ModelError, RecordingError, SummaryFileError, TooLittleDataError, std::invalid_argument
ExciteReport make_excite_report(const ToolOptions& options, ProgressLine& progress);

/// A table of the largest share of every limit. @param check_rate  Hz, at which they were looked at
std::string limits_table(const LinearModel& model, const MotionLimits& limits,
                         const LimitShares& shares, double check_rate = kCheckRate);

/// How the trajectory is to be recorded, a sentence.
std::string recording_advice(const ExciteReport& report);

/// What the command prints.
std::string text_of(const ExciteReport& report);

/// The page. @param command  as it was called
ReportDocument excite_document(const ExciteReport& report, const std::string& command);

/// Schema "dynid.excitation/1".
std::string json_of(const ExciteReport& report, const std::string& trajectory_path);

}  // namespace dyngen::runtime
