// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "runtime/recordings/notice_log.h"
#include "runtime/recordings/row_queue.h"

namespace dyngen::runtime {

/// Fewer steps back in time are runs that follow each other in one file.
inline constexpr std::size_t kFewestBackwardSteps = 3;

/// Sorts rows by time within their segment, if they are rows of a regular recording in another
/// order: time goes backward kFewestBackwardSteps times or more, and sorted 95 % of the steps are
/// within 20 % of the median step and no time stands twice with other values. Runs that begin again
/// at the same time are thus left as they are.
///
/// Rows without a time are left out where rows are sorted, since they have no place.
/// @param width  values of a row
/// @return  true if `rows` were sorted, which is told
bool sort_shuffled_rows(RowQueue& rows, std::size_t width, NoticeLog& log);

}  // namespace dyngen::runtime
