// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/identification/motion_source.h"
#include "runtime/tools/dynid/fit/fit_with_effects.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// A recording without the torque of the numbers that are held; the recording itself where none is.
MotionSource without_held(const MotionSource& source, const DescribedRobot& robot);

/// What a reader should know of the file's numbers: which are held; or, if none is, that the file
/// looks as if they were meant to be: some links are all numbers, and a link or a load is unknown.
std::vector<std::string> notes_of_numbers(const DescribedRobot& robot, const EffectTask& task);

}  // namespace dyngen::runtime
