// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/plausibility/judge.h"

namespace dyngen::runtime {

/// What the model's torque says of the recordings' columns and of the robot file's gravity.
void add_model_remarks(const JudgedRobot& robot, const std::vector<MotionSource>& sources,
                       std::vector<Remark>& remarks);

}  // namespace dyngen::runtime
