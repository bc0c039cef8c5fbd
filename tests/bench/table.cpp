// SPDX-License-Identifier: MIT
#include "tests/bench/table.h"

#include <fmt/format.h>

#include <algorithm>

namespace dyngen::bench {

std::string Table::text() const {
  std::vector<std::size_t> widths(header.size(), 0);
  const auto widen = [&](const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  };
  widen(header);
  for (const auto& row : rows) widen(row);
  std::string result;
  const auto write = [&](const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      result += i == 0 ? fmt::format("{:<{}}", row[i], widths[i])
                       : fmt::format("  {:>{}}", row[i], widths[i]);
    }
    result += '\n';
  };
  write(header);
  for (const auto& row : rows) write(row);
  return result;
}

std::string Table::markdown() const {
  std::string result;
  const auto write = [&](const std::vector<std::string>& row) {
    for (const std::string& cell : row) result += fmt::format("| {} ", cell);
    result += "|\n";
  };
  write(header);
  for (std::size_t i = 0; i < header.size(); ++i) result += i == 0 ? "|---|" : "---:|";
  result += '\n';
  for (const auto& row : rows) write(row);
  return result;
}

}  // namespace dyngen::bench
