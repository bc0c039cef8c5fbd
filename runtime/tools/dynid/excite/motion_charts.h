// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/excitation/motion_limits.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/report/document.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// The first rows of a trajectory, a panel a joint: position, speed, acceleration and, where they
/// are limited, torque; each with its limits, dashed.
ReportChart motion_chart(const LinearModel& model, const MotionLimits& limits,
                         const Trajectory& trajectory, Eigen::Index rows);

/// How much of its limits each joint uses. Joints that come to 95 % of one are marked.
ReportBars limit_bars(const LinearModel& model, const MotionLimits& limits,
                      const LimitShares& shares);

/// The arm in the middle of a trajectory.
ReportArm motion_arm(const DescribedRobot& robot, const Trajectory& trajectory);

}  // namespace dyngen::runtime
