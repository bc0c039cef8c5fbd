// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/logs/raw_log.h"

namespace dyngen::runtime {

/// A variable of a file of arrays: rows are samples.
struct ArrayVariable {
  std::string table;  ///< that it is part of: a struct, a group, a file; may be empty
  std::string name;   ///< of its columns: "name", or "name[1]", "name[2]", ...
  std::size_t rows = 0, columns = 1;
  std::string unit;
  std::optional<ColumnOrigin> origin;     ///< taken off all values
  std::vector<std::string> column_names;  ///< in place of "name[1]", ...; empty: those
  /// Fills a block (count x columns) with rows from `begin` on. @throws LogError
  std::function<void(std::size_t begin, Eigen::Ref<Eigen::MatrixXd> block)> read;
};

/// Variables of one table name with as many rows are one table; where a name has several lengths,
/// those after the first get " (N rows)". Variables of fewer than 10 rows beside longer ones are
/// numbers of the setup, not samples: they are left out and told. Infinite values become NaN.
///
/// @param file  for messages
/// @throws LogError if there are no variables
std::unique_ptr<RawLog> make_array_log(std::vector<ArrayVariable> variables,
                                       std::vector<std::string> notices, const std::string& file);

/// How an array with two sides lies: samples along the longer side; the second one where a row is
/// all there is.
/// @return  true: samples are along the second side
bool samples_are_second(std::size_t first, std::size_t second);

}  // namespace dyngen::runtime
