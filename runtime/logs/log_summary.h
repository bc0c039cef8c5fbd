// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runtime/logs/raw_log.h"

namespace dyngen::runtime {

/// What one column of a log holds.
struct ColumnSummary {
  std::string name, unit;
  std::size_t values = 0;                 ///< that are no NaN
  double first = 0, least = 0, most = 0;  ///< NaN without values
};

struct TableSummary {
  std::string name;
  std::size_t rows = 0;
  std::vector<ColumnSummary> columns;
};

/// Reads a log to its end. @throws LogError
std::vector<TableSummary> summary_of(RawLog& log);

/// The same as text: a heading for each table, a line for each column with its unit, the number of
/// values and their range; then what was repaired or left out.
std::string log_summary(RawLog& log);

}  // namespace dyngen::runtime
