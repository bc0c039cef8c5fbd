// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/tools/dynid/excite/excite_limits.h"
#include "runtime/tools/dynid/excite/excite_report.h"
#include "runtime/tools/dynid/robot/json_numbers.h"

namespace dyngen::runtime {

/// The largest share of every limit that a motion uses.
Json shares_json(const MotionLimits& limits, const LimitShares& shares,
                 double check_rate = kCheckRate);

}  // namespace dyngen::runtime
