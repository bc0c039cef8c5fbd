// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/tools/dynid/fit/fit_report.h"

namespace dyngen::runtime {

/// Full, physically consistent parameters from a report's equations and the file's values.
ConsistentFit fit_consistently(const FitReport& report);

}  // namespace dyngen::runtime
