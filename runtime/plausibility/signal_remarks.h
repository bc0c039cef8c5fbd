// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/plausibility/judge.h"

namespace dyngen::runtime {

/// What a recording's columns say by themselves, and beside the limits of the robot.
void add_signal_remarks(const JudgedRobot& robot, const MotionSource& source,
                        std::vector<Remark>& remarks);

}  // namespace dyngen::runtime
