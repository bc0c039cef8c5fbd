// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/recordings/notice.h"
#include "runtime/recordings/recording.h"

namespace dyngen::runtime {

/// Makes the temperatures of a recording complete, and tells what was done to them.
///
/// A sensor is often slower than the rows, so that most cells are empty (NaN). They are filled
/// along straight lines over time, across runs too; before the first and after the last value the
/// nearest one holds. A column whose mean is that of kelvins becomes degrees Celsius. Where a
/// column has no value at all, all temperatures are left out. A number of columns that is neither 1
/// nor that of the joints is told, and left as it is: no Motion has it.
void repair_temperatures(Recording& recording, std::vector<Notice>& notices);

}  // namespace dyngen::runtime
