// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/import/signed_numbers.h"
#include "runtime/logs/raw_log.h"

namespace dyngen::runtime {

/// The rows of one table that are still needed: some columns of each, numbered from the table's
/// first row.
class TableWindow {
 public:
  /// @param bits  of signed numbers that the log holds as unsigned ones: signed_value()
  /// @return  place of the column within a row here
  std::size_t keep_column(std::size_t column, int bits = 0);
  void append(const LogRows& rows);
  /// Rows before this one are needed no more.
  void release(std::size_t row);

  [[nodiscard]] const std::vector<std::size_t>& columns() const { return columns_; }
  [[nodiscard]] std::size_t end() const { return first_ + places_.size() - head_; }
  [[nodiscard]] double value(std::size_t row, std::size_t kept) const {
    return values_[(row - first_ + head_) * columns_.size() + kept];
  }
  [[nodiscard]] std::uint64_t place(std::size_t row) const { return places_[row - first_ + head_]; }
  /// What the log's own values of a kept column look like.
  [[nodiscard]] const UnsignedWatch& watch(std::size_t kept) const { return watches_[kept]; }
  /// Numbers held.
  [[nodiscard]] std::size_t held() const { return (places_.size() - head_) * columns_.size(); }

 private:
  std::vector<std::size_t> columns_;
  std::vector<int> bits_;  ///< of each
  std::vector<UnsignedWatch> watches_;
  std::vector<double> values_;
  std::vector<std::uint64_t> places_;
  std::size_t head_ = 0;   ///< rows at the front that are released
  std::size_t first_ = 0;  ///< number of the row at head_
};

}  // namespace dyngen::runtime
