// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/logs/raw_log.h"

namespace dyngen::test {

/// A table of a log, all of its rows.
struct WholeTable {
  std::string name;
  std::vector<std::string> columns, units;
  std::vector<std::vector<double>> rows;
  std::vector<std::uint64_t> places;

  /// The values of a column. Fails if there is none of that name.
  [[nodiscard]] std::vector<double> column(const std::string& name) const;
};

struct WholeLog {
  std::vector<WholeTable> tables;
  std::string notices;  ///< one a line
};

/// All that is in a log. @param at_most  rows asked for at once
WholeLog read_whole(runtime::RawLog& log, std::size_t at_most = 7);

/// The same of a text.
WholeLog read_text(const std::string& text, const runtime::LogTextSettings& settings = {});

/// What is wrong with a log: the message of its LogError; empty: nothing is.
std::string error_of(const std::string& bytes, const std::string& name = "run.log");

/// Equal numbers, or both NaN.
bool same_number(double a, double b);

std::string bytes_of_file(const std::string& path);

}  // namespace dyngen::test
