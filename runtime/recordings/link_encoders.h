// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/recordings/notice.h"
#include "runtime/recordings/recording.h"

namespace dyngen::runtime {

/// Whether columns ql are positions of the same joints as q, in the same unit, direction and zero.
///
/// A column that is one number while its joint moves is no encoder: it becomes NaN, and a notice
/// says so. Whole turns between q and ql are taken off, with a notice.
/// @throws RecordingError  at the name of the column: it has another sign, unit, gear ratio or
/// zero,
///         or does not follow q
void check_link_encoders(Recording& recording, std::vector<Notice>& notices);

}  // namespace dyngen::runtime
