// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "runtime/excitation/motion_limits.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// What of the limits the command line says.
struct LimitOptions {
  double share = 1;                  ///< of all limits of the file, in (0, 1]
  std::vector<double> acceleration;  ///< one for all joints or one each; empty: the file's
  /// m, frame 0: xmin xmax ymin ymax zmin zmax that the tool's point must not enter
  std::optional<std::array<double, 6>> keep_out;
  std::array<double, 3> tool = {0, 0, 0};  ///< m: the tool's point in the frame of the last link
};

/// Limits of a robot with what had to be assumed.
struct RobotLimits {
  MotionLimits limits;
  std::vector<std::string> notes;  ///< a sentence each
};

/// The limits of the file's rows qmin, qmax, vmax, amax and taumax for its moving joints. What the
/// file does not say: positions within a turn (half a metre where a joint slides); accelerations
/// that reach vmax in a quarter of a second, or 10 rad/s^2 (m/s^2); torque is not limited, nor
/// where a parameter has no number in the file.
/// @throws std::invalid_argument  if options do not fit the robot; ModelError  if a limit is no
///         number, or qmin is not below qmax
RobotLimits limits_of(const DescribedRobot& robot, const LimitOptions& options);

}  // namespace dyngen::runtime
