// SPDX-License-Identifier: MIT
#include "tests/runtime/logs/read_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace dyngen::test {

std::vector<double> WholeTable::column(const std::string& wanted) const {
  const auto found = std::find(columns.begin(), columns.end(), wanted);
  if (found == columns.end()) {
    ADD_FAILURE() << "no column " << wanted << " in table '" << name << "'";
    return {};
  }
  std::vector<double> values;
  for (const auto& row : rows) {
    values.push_back(row[static_cast<std::size_t>(found - columns.begin())]);
  }
  return values;
}

WholeLog read_whole(runtime::RawLog& log, std::size_t at_most) {
  WholeLog whole;
  for (const runtime::LogTable& table : log.tables()) {
    whole.tables.push_back({table.name, table.columns, table.units, {}, {}});
  }
  for (runtime::LogRows rows; log.next(rows, at_most);) {
    WholeTable& table = whole.tables.at(rows.table);
    EXPECT_GT(rows.values.rows(), 0);
    EXPECT_LE(static_cast<std::size_t>(rows.values.rows()), at_most);
    EXPECT_EQ(static_cast<std::size_t>(rows.values.cols()), table.columns.size());
    EXPECT_EQ(static_cast<std::size_t>(rows.values.rows()), rows.places.size());
    for (Eigen::Index i = 0; i < rows.values.rows(); ++i) {
      std::vector<double> row;
      for (Eigen::Index k = 0; k < rows.values.cols(); ++k) row.push_back(rows.values(i, k));
      table.rows.push_back(std::move(row));
    }
    table.places.insert(table.places.end(), rows.places.begin(), rows.places.end());
  }
  EXPECT_EQ(log.fraction_read(), 1);
  for (const std::string& notice : log.notices()) whole.notices += notice + "\n";
  return whole;
}

WholeLog read_text(const std::string& text, const runtime::LogTextSettings& settings) {
  const auto log = runtime::open_log_bytes(text, "run.csv", settings);
  return read_whole(*log);
}

std::string error_of(const std::string& bytes, const std::string& name) {
  try {
    const auto log = runtime::open_log_bytes(bytes, name);
    for (runtime::LogRows rows; log->next(rows, 100);) {
    }
  } catch (const runtime::LogError& error) {
    return error.what();
  }
  return {};
}

bool same_number(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

std::string bytes_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace dyngen::test
