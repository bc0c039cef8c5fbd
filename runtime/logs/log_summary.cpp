// SPDX-License-Identifier: MIT
#include "runtime/logs/log_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dyngen::runtime {

std::vector<TableSummary> summary_of(RawLog& log) {
  constexpr std::size_t kRowsOfSummary = 1 << 12;
  std::vector<TableSummary> tables;
  for (const LogTable& table : log.tables()) {
    TableSummary summary{table.name, 0, {}};
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
      summary.columns.push_back({table.columns[i], table.units[i], 0, kNone, kNone, kNone});
    }
    tables.push_back(std::move(summary));
  }
  for (LogRows rows; log.next(rows, kRowsOfSummary);) {
    TableSummary& table = tables[rows.table];
    table.rows += static_cast<std::size_t>(rows.values.rows());
    for (Eigen::Index i = 0; i < rows.values.cols(); ++i) {
      ColumnSummary& column = table.columns[static_cast<std::size_t>(i)];
      for (Eigen::Index row = 0; row < rows.values.rows(); ++row) {
        const double value = rows.values(row, i);
        if (std::isnan(value)) continue;
        if (column.values++ == 0) column.first = column.least = column.most = value;
        column.least = std::min(column.least, value);
        column.most = std::max(column.most, value);
      }
    }
  }
  return tables;
}

std::string log_summary(RawLog& log) {
  std::string text;
  for (const TableSummary& table : summary_of(log)) {
    std::size_t width = 6;
    for (const ColumnSummary& column : table.columns) width = std::max(width, column.name.size());
    text += fmt::format("{}{} rows, {} columns\n",
                        table.name.empty() ? std::string() : table.name + ": ", table.rows,
                        table.columns.size());
    text += fmt::format("  {:<{}}  {:<8} {:>9} {:>14} {:>14}\n", "column", width, "unit", "values",
                        "least", "most");
    for (const ColumnSummary& column : table.columns) {
      const std::string unit = column.unit.empty() ? "-" : column.unit;
      text += column.values == 0
                  ? fmt::format("  {:<{}}  {:<8} {:>9}\n", column.name, width, unit, 0)
                  : fmt::format("  {:<{}}  {:<8} {:>9} {:>14.6g} {:>14.6g}\n", column.name, width,
                                unit, column.values, column.least, column.most);
    }
  }
  for (const std::string& notice : log.notices()) text += notice + "\n";
  return text;
}

}  // namespace dyngen::runtime
