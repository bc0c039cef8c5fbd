// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/tools/dynid/ripple/joint_ripple.h"
#include "runtime/tools/dynid/robot/json_numbers.h"

namespace dyngen::runtime {

/// The array `ripple` of docs/reference/diagnosis.md.
Json ripple_json(const JointRipples& ripples);

}  // namespace dyngen::runtime
