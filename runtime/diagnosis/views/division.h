// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/identification/motion_source.h"

namespace dyngen::runtime {

/// Recordings that are fitted, and those that only prove the answer.
struct Division {
  std::vector<MotionSource> train, heldout;
};

/// A fifth of every recording is held out: the last in which all joints move about as much of the
/// time as in the whole recording, since what stands still proves nothing.
Division divided(const std::vector<MotionSource>& recordings);

}  // namespace dyngen::runtime
