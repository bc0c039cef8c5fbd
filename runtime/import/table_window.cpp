// SPDX-License-Identifier: MIT
#include "runtime/import/table_window.h"

#include <algorithm>

namespace dyngen::runtime {

std::size_t TableWindow::keep_column(std::size_t column, int bits) {
  for (std::size_t kept = 0; kept < columns_.size(); ++kept) {
    if (columns_[kept] == column && bits_[kept] == bits) return kept;
  }
  columns_.push_back(column);
  bits_.push_back(bits);
  watches_.emplace_back();
  return columns_.size() - 1;
}

void TableWindow::append(const LogRows& rows) {
  const auto count = static_cast<std::size_t>(rows.values.rows());
  if (head_ > 0 && head_ >= places_.size() - head_) {
    const auto rows_gone = static_cast<std::ptrdiff_t>(head_);
    values_.erase(values_.begin(),
                  values_.begin() + rows_gone * static_cast<std::ptrdiff_t>(columns_.size()));
    places_.erase(places_.begin(), places_.begin() + rows_gone);
    head_ = 0;
  }
  const std::size_t begin = values_.size();
  values_.resize(begin + count * columns_.size());
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const auto column = rows.values.col(static_cast<Eigen::Index>(columns_[c]));
    for (std::size_t k = 0; k < count; ++k) {
      const double value = column[static_cast<Eigen::Index>(k)];
      watches_[c].look(value);
      values_[begin + k * columns_.size() + c] = signed_value(value, bits_[c]);
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    places_.push_back(k < rows.places.size() ? rows.places[k] : end() + 1);
  }
}

void TableWindow::release(std::size_t row) {
  row = std::min(row, end());
  if (row <= first_) return;
  head_ += row - first_;
  first_ = row;
}

}  // namespace dyngen::runtime
