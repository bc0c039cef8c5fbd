// SPDX-License-Identifier: MIT
#include "runtime/logs/row_rounds.h"

#include <algorithm>
#include <limits>

namespace dyngen::runtime {

RowRounds::RowRounds(std::vector<std::size_t> widths) : tables_(widths.size()) {
  for (std::size_t i = 0; i < widths.size(); ++i) tables_[i].width = widths[i];
}

double* RowRounds::add(std::size_t table, std::uint64_t place) {
  Waiting& waiting = tables_[table];
  waiting.places.push_back(place);
  waiting.values.resize(waiting.values.size() + waiting.width,
                        std::numeric_limits<double>::quiet_NaN());
  ++waiting_;
  return waiting.values.data() + waiting.values.size() - waiting.width;
}

void RowRounds::drop_last(std::size_t table) {
  Waiting& waiting = tables_[table];
  waiting.places.pop_back();
  waiting.values.resize(waiting.values.size() - waiting.width);
  --waiting_;
}

void RowRounds::take(LogRows& rows, std::size_t at_most) {
  const auto first = std::find_if(tables_.begin(), tables_.end(), [](const Waiting& waiting) {
    return waiting.taken < waiting.places.size();
  });
  Waiting& waiting = *first;
  rows.table = static_cast<std::size_t>(first - tables_.begin());
  const std::size_t count = std::min(at_most, waiting.places.size() - waiting.taken);
  const auto begin = waiting.places.begin() + static_cast<std::ptrdiff_t>(waiting.taken);
  rows.places.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  rows.values = Eigen::Map<const RowMajor>(waiting.values.data() + waiting.taken * waiting.width,
                                           static_cast<Eigen::Index>(count),
                                           static_cast<Eigen::Index>(waiting.width));
  waiting.taken += count;
  waiting_ -= count;
  if (waiting.taken == waiting.places.size()) {
    waiting.taken = 0;
    waiting.values.clear();
    waiting.places.clear();
  }
}

}  // namespace dyngen::runtime
