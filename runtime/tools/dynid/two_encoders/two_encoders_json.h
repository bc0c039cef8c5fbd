// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/tools/dynid/robot/json_numbers.h"
#include "runtime/tools/dynid/two_encoders/two_encoders.h"

namespace dyngen::runtime {

/// The array `two_encoders` of docs/reference/diagnosis.md.
Json two_encoders_json(const TwoEncoders& encoders);

}  // namespace dyngen::runtime
