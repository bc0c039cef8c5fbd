// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/tool/progress_line.h"
#include "runtime/plausibility/judge.h"
#include "runtime/tools/dynid/options/options.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// What the file knows of a robot before a fit. @param robot  must outlive it
JudgedRobot judged_robot(const DescribedRobot& robot);

/// Judges recordings before anything is fitted to them, and prints what it finds to standard error.
/// @return  the findings, in words, for the report
/// @throws ImplausibleError  if some are refused and --as-recorded was not given
std::vector<std::string> judge_recordings(const DescribedRobot& robot,
                                          const std::vector<MotionSource>& sources,
                                          const ToolOptions& options, ProgressLine& progress);

}  // namespace dyngen::runtime
