// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/plots/figure.h"
#include "runtime/tools/dynid/excite/excite_report.h"

namespace dyngen::runtime {

/// The first rows of a trajectory: position, speed, acceleration and, where they are limited,
/// torque of every joint, in shares of their limits.
Figure motion_picture(const LinearModel& model, const MotionLimits& limits,
                      const Trajectory& trajectory, Eigen::Index rows, const std::string& title);

/// One period: position, speed, acceleration and, where the file has the numbers for it, torque of
/// every joint, in shares of their limits.
Figure picture_of(const ExciteReport& report);

}  // namespace dyngen::runtime
