// SPDX-License-Identifier: MIT
#include "runtime/recordings/shuffled_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace dyngen::runtime {
namespace {

/// Is time regular in this order of the rows?
bool order_is_regular(const RowQueue& rows, const std::vector<std::size_t>& order,
                      std::size_t width) {
  std::vector<double> steps;
  std::size_t twice = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (rows.info(order[i]).segment != rows.info(order[i - 1]).segment) continue;
    const double step = rows.time(order[i]) - rows.time(order[i - 1]);
    if (step > 0) {
      steps.push_back(step);
      continue;
    }
    const double* values = rows.values(order[i]);
    if (!std::equal(values, values + width, rows.values(order[i - 1]))) return false;
    ++twice;
  }
  if (steps.empty() || 100 * twice > steps.size()) return false;
  std::vector<double> sorted = steps;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  constexpr double kOff = 0.2, kRegular = 0.95;
  const auto regular = std::count_if(steps.begin(), steps.end(), [&](double step) {
    return std::abs(step - *middle) <= kOff * *middle;
  });
  return static_cast<double>(regular) >= kRegular * static_cast<double>(steps.size());
}

}  // namespace

bool sort_shuffled_rows(RowQueue& rows, std::size_t width, NoticeLog& log) {
  std::vector<std::size_t> order;
  order.reserve(rows.size());
  std::size_t backward = 0, first = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (std::isnan(rows.time(i))) continue;
    if (!order.empty() && rows.info(i).segment == rows.info(order.back()).segment &&
        rows.time(i) < rows.time(order.back()) && backward++ == 0) {
      first = i;
    }
    order.push_back(i);
  }
  if (backward < kFewestBackwardSteps) return false;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto segment_a = rows.info(a).segment, segment_b = rows.info(b).segment;
    return segment_a != segment_b ? segment_a < segment_b : rows.time(a) < rows.time(b);
  });
  if (!order_is_regular(rows, order, width)) return false;

  const std::size_t untimed = rows.size() - order.size();
  log.add_once(
      "shuffled", rows.info(first).line, 0,
      fmt::format("found rows that are not in the order of time ({} steps back, the first "
                  "here); sorted by time{}",
                  backward,
                  untimed == 0 ? std::string()
                               : fmt::format(", {} rows without a time are left out", untimed)));
  RowQueue sorted(width);
  for (const std::size_t i : order) sorted.push(rows.values(i), rows.info(i));
  rows = std::move(sorted);
  return true;
}

}  // namespace dyngen::runtime
