// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "runtime/logs/raw_log.h"

namespace dyngen::runtime {

/// The first rows of one table of a log, for guesses.
struct SampledTable {
  std::size_t log = 0;  ///< which file
  LogTable table;
  Eigen::MatrixXd values;            ///< (rows x columns)
  std::vector<std::string> words{};  ///< of columns with one word in all rows; else empty
};

/// The first rows of all tables.
struct SampledLog {
  std::vector<std::string> paths;
  std::vector<SampledTable> tables;  ///< those that have rows
};

/// @param most  rows of each table  @throws RecordingError
SampledLog sample_logs(const std::vector<std::string>& paths, std::size_t most = 20000);

}  // namespace dyngen::runtime
