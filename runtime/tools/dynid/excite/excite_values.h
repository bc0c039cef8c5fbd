// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/excitation/motion_limits.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/tools/dynid/excite/excite_limits.h"
#include "runtime/tools/dynid/options/excite_options.h"

namespace dyngen::runtime {

/// What an option says of every joint. @param option  for the message
/// @throws std::invalid_argument  if there are neither one value nor one for each joint
Eigen::VectorXd one_or_each(const std::vector<double>& values, Eigen::Index joints,
                            const char* option);

/// What of the limits a command line asks for.
LimitOptions asked_limits(const ExciteOptions& options);

/// A period in whole rows of the file.
struct PeriodOfRows {
  double duration = 0;  ///< s
  int samples = 0;
  std::string note;  ///< where the rate is not quite the one asked for
};
/// @throws std::invalid_argument  if that is fewer than 10 rows
PeriodOfRows period_of_rows(const ExciteOptions& options);

/// Periods that are written where the command line does not say how many.
inline constexpr int kUsualPeriods = 5;

/// Periods one after the other, with the end of the last one.
Trajectory repeated(const JointMotion& period, int periods, double duration);

}  // namespace dyngen::runtime
