// SPDX-License-Identifier: MIT
// Any bytes are either a log or a LogError that names the file; nothing else may happen, and rows do
// not depend on how many are asked for at once.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/logs/raw_log.h"

namespace {

using dyngen::runtime::LogError;
using dyngen::runtime::LogRows;
using dyngen::runtime::RawLog;

[[noreturn]] void fail_log(const char* claim, std::string_view detail) {
  std::fprintf(stderr, "violated: %s\n%.*s\n", claim, static_cast<int>(detail.size()),
               detail.data());
  std::abort();
}

struct LogOutcome {
  std::string error;
  std::vector<std::size_t> rows;  ///< of each table
  std::vector<double> sums;       ///< of each table, in the order of its rows
};

void check_rows(const RawLog& log, const LogRows& rows, std::size_t at_most) {
  if (rows.table >= log.tables().size()) fail_log("a table is one of the log's", "");
  const auto count = static_cast<std::size_t>(rows.values.rows());
  if (count == 0 || count > at_most || rows.places.size() != count) fail_log("sizes fit", "");
  if (static_cast<std::size_t>(rows.values.cols()) != log.tables()[rows.table].columns.size()) {
    fail_log("columns fit", "");
  }
  for (const std::uint64_t place : rows.places) {
    if (place == 0) fail_log("places count from 1", "");
  }
}

LogOutcome read_log(const std::string& bytes, std::size_t at_most) {
  LogOutcome outcome;
  try {
    const auto log = dyngen::runtime::open_log_bytes(bytes, "fuzz.log");
    outcome.rows.resize(log->tables().size());
    outcome.sums.resize(log->tables().size());
    for (const auto& table : log->tables()) {
      if (table.columns.size() != table.units.size()) fail_log("each column has a unit", "");
    }
    for (LogRows rows; log->next(rows, at_most);) {
      check_rows(*log, rows, at_most);
      outcome.rows[rows.table] += static_cast<std::size_t>(rows.values.rows());
      for (Eigen::Index i = 0; i < rows.values.rows(); ++i) {
        for (Eigen::Index k = 0; k < rows.values.cols(); ++k) {
          const double value = rows.values(i, k);
          if (std::isinf(value)) fail_log("values are finite or NaN", "");
          if (!std::isnan(value)) outcome.sums[rows.table] += std::abs(value);
        }
      }
    }
    if (log->fraction_read() != 1) fail_log("all was read", "");
    for (const std::string& notice : log->notices()) {
      if (!notice.starts_with("fuzz.log:")) fail_log("a notice names the file", notice);
    }
  } catch (const LogError& error) {
    outcome = {};
    outcome.error = error.what();
    if (!outcome.error.starts_with("fuzz.log:") ||
        outcome.error.find("error: ") == std::string::npos) {
      fail_log("an error names the file", outcome.error);
    }
  }
  return outcome;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const LogOutcome whole = read_log(bytes, 1 << 20);
  const LogOutcome pieces = read_log(bytes, 5);
  if (whole.error != pieces.error) fail_log("pieces make no difference", whole.error + pieces.error);
  if (whole.rows != pieces.rows || whole.sums != pieces.sums) {
    fail_log("pieces make no difference", "");
  }
  return 0;
}
