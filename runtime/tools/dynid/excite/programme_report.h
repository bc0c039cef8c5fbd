// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/discrimination/steady_programme.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/report/document.h"
#include "runtime/tools/dynid/excite/excite_limits.h"
#include "runtime/tools/dynid/options/excite_options.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// Everything of `dynid excite --archetype`.
struct ProgrammeReport {
  ExciteOptions options;
  ProgrammeOptions asked;
  DescribedRobot robot;
  MotionLimits limits;
  std::vector<std::string> notes;  ///< what was assumed; a sentence each
  Programme programme;
  bool found = false;
  std::string message;    ///< which limit is passed, if one is
  LimitShares shares;     ///< at kProgrammeCheckRate
  int samples = 0;        ///< rows of one pass
  int periods = 1;        ///< that are written
  double duration = 0;    ///< s, of one pass
  Trajectory trajectory;  ///< all passes
};

/// Hz, at which limits are looked at: positions, speeds and accelerations hold by the way strokes
/// are made; torque and the box change slowly.
inline constexpr double kProgrammeCheckRate = 1000;

/// @throws ModelError  of a file without qmin, qmax or vmax, at its place; std::invalid_argument
ProgrammeReport make_programme_report(const RobotSource& robot, const ExciteOptions& options);

/// One line for each joint: how many steps, from which speed to which.
struct ProgrammeLine {
  int joint = 0;  ///< from 0
  int steps = 0;
  double slowest = 0, fastest = 0, shortest = 0, longest = 0;  ///< rad/s or m/s; s
};
std::vector<ProgrammeLine> programme_lines(const ProgrammeReport& report);

/// How the programme is to be recorded, a sentence.
std::string programme_advice(const ProgrammeReport& report);

/// What the command prints.
std::string programme_text(const ProgrammeReport& report);
/// The page. @param command  as it was called
ReportDocument programme_document(const ProgrammeReport& report, const std::string& command);
/// Schema "dynid.programme/1".
std::string programme_json(const ProgrammeReport& report, const std::string& trajectory_path);

}  // namespace dyngen::runtime
