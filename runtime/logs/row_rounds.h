// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/logs/raw_log.h"

namespace dyngen::runtime {

/// Rows of several tables that wait to be handed out, table by table.
class RowRounds {
 public:
  /// @param widths  columns of each table
  explicit RowRounds(std::vector<std::size_t> widths);

  /// A new last row of a table, of NaN. Valid until the next call.
  double* add(std::size_t table, std::uint64_t place);

  /// Takes the row that add() gave last back.
  void drop_last(std::size_t table);

  /// Rows that wait, of all tables.
  [[nodiscard]] std::size_t waiting() const { return waiting_; }

  /// Moves up to `at_most` rows of the first table that has some; waiting() > 0.
  void take(LogRows& rows, std::size_t at_most);

 private:
  struct Waiting {
    std::size_t width = 0;
    std::size_t taken = 0;  ///< rows at the front that were handed out
    std::vector<double> values;
    std::vector<std::uint64_t> places;
  };
  std::vector<Waiting> tables_;
  std::size_t waiting_ = 0;
};

}  // namespace dyngen::runtime
