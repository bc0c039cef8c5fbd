// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "runtime/discrimination/separating_trajectory.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/report/document.h"
#include "runtime/tools/dynid/excite/excite_values.h"
#include "runtime/tools/dynid/excite/finding_file.h"
#include "runtime/tools/dynid/options/excite_options.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// The chi-square from which on names are separable (docs/reference/diagnosis.md).
inline constexpr double kSeparated = 20;

/// Everything that `dynid excite --for` found, and what it was asked.
struct SeparationReport {
  ExciteOptions options;
  DescribedRobot robot;
  OpenFinding finding;
  EffectInstance effect;            ///< of the finding, with its numbers
  std::vector<std::string> rivals;  ///< families
  MotionLimits limits;
  Eigen::VectorXd noise;           ///< (n) N m or N, of one sample
  std::string noise_from;          ///< a sentence
  std::vector<std::string> notes;  ///< what was assumed; a sentence each
  SeparatingTrajectory designed;   ///< separations are of one period
  double duration = 0;             ///< s, of one period
  int samples = 0;                 ///< of one period
  int periods = kUsualPeriods;     ///< that are written
  Trajectory trajectory;           ///< all periods
};

/// The finding as an effect of the catalogue, and its rivals on the robot.
struct Contest {
  EffectInstance finding;
  std::vector<EffectInstance> rivals;  ///< NaN where a parameter is looked for
};
/// @param path  of the findings, for messages
/// @throws std::invalid_argument  naming the family, joint or parameter that does not fit
Contest contest_of(const OpenFinding& finding, const std::string& path, const DescribedRobot& robot,
                   const std::vector<std::string>& effect_folders);

/// @param progress  may be empty
/// @throws ModelError, std::invalid_argument
SeparationReport make_separation_report(
    const RobotSource& robot, const ExciteOptions& options,
    const std::function<void(const std::string&, std::size_t, std::size_t)>& progress);

/// The nearest rival of every family, over one period.
std::map<std::string, RivalSeparation> nearest_rivals(const Separation& separation);

/// What one run of one robot does not have: a payload, another temperature. Sentences; empty: none.
std::string instruction_of(const SeparationReport& report);

/// How the trajectory is to be recorded, a sentence.
std::string recording_advice(const SeparationReport& report);

/// The page. @param command  as it was called
ReportDocument separation_document(const SeparationReport& report, const std::string& command);

/// What the command prints.
std::string separation_text(const SeparationReport& report);

/// Schema "dynid.separation/1".
std::string separation_json(const SeparationReport& report, const std::string& trajectory_path);

}  // namespace dyngen::runtime
