// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/plots/figure.h"
#include "runtime/tools/dynid/excite_report.h"

namespace dyngen::runtime {

/// One period: position, speed, acceleration and, where the file has the numbers for it, torque of
/// every joint, in shares of their limits.
Figure picture_of(const ExciteReport& report);

}  // namespace dyngen::runtime
