// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dyngen::runtime {

/// What is known of a row beside its values.
struct RowInfo {
  std::size_t line = 0;
  std::int64_t segment = 0;    ///< counts changes of the segment column
  std::size_t bad_column = 0;  ///< in the line, of the first bad value; 0: none is bad
  std::string bad_word;        ///< that value, and where: "'nan' in q2"
  bool starts_run = false;

  [[nodiscard]] bool bad() const { return bad_column != 0; }
};

/// Rows in the order of time, first in first out, each `width` values; a bad value is NaN. Grows as
/// needed and keeps its memory.
class RowQueue {
 public:
  explicit RowQueue(std::size_t width) : width_(width) { grow(16); }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] double* values(std::size_t row) { return values_.data() + slot(row) * width_; }
  [[nodiscard]] const double* values(std::size_t row) const {
    return values_.data() + slot(row) * width_;
  }
  [[nodiscard]] RowInfo& info(std::size_t row) { return info_[slot(row)]; }
  [[nodiscard]] const RowInfo& info(std::size_t row) const { return info_[slot(row)]; }
  [[nodiscard]] double time(std::size_t row) const { return values(row)[0]; }

  /// A new last row, its values and info left over from an earlier one.
  void add() {
    if (size_ == info_.size()) grow(2 * size_);
    ++size_;
  }
  void push(const double* row, const RowInfo& info) {
    add();
    std::copy(row, row + width_, values(size_ - 1));
    info_[slot(size_ - 1)] = info;
  }
  void pop_front() {
    first_ = slot(1);
    --size_;
  }
  void pop_back() { --size_; }
  void clear() { first_ = size_ = 0; }

 private:
  [[nodiscard]] std::size_t slot(std::size_t row) const {
    return (first_ + row) & (info_.size() - 1);
  }
  void grow(std::size_t capacity) {  // a power of two
    std::vector<double> values(capacity * width_);
    std::vector<RowInfo> info(capacity);
    for (std::size_t row = 0; row < size_; ++row) {
      std::copy(this->values(row), this->values(row) + width_, values.data() + row * width_);
      info[row] = std::move(this->info(row));
    }
    values_.swap(values);
    info_.swap(info);
    first_ = 0;
  }

  std::size_t width_;
  std::vector<double> values_;
  std::vector<RowInfo> info_;
  std::size_t first_ = 0, size_ = 0;
};

}  // namespace dyngen::runtime
