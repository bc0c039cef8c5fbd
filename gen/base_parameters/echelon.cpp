// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/base_parameters/echelon.h"

#include <cln/float.h>
#include <cln/integer.h>
#include <cln/rational.h>

#include <utility>

namespace dyngen {
namespace {

using cln::cl_R;

/// Divides a row by its largest entry. @return false if there is nothing in it
bool scale(std::vector<cl_R>& row) {
  cl_R largest = 0;
  for (const cl_R& value : row) {
    if (cln::abs(value) > largest) largest = cln::abs(value);
  }
  if (largest < rounding_limit()) return false;
  for (cl_R& value : row) value = value / largest;
  return true;
}

/// row -= row[column] * by, where by has a 1 at the column.
void clear(std::vector<cl_R>& row, const std::vector<cl_R>& by, std::size_t column) {
  const cl_R factor = row[column];
  if (cln::zerop(factor)) return;
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (cln::zerop(by[c])) continue;
    row[c] = row[c] - factor * by[c];
    if (cln::abs(row[c]) < rounding_limit()) row[c] = 0;
  }
  row[column] = 0;
}

}  // namespace

const cl_R& rounding_limit() {
  static const cl_R limit = cln::cl_RA("1/1000000000000000000000000000000000000000000");
  return limit;
}

Echelon echelon(NumberMatrix rows, std::size_t columns) {
  NumberMatrix left;
  for (std::vector<cl_R>& row : rows) {
    if (scale(row)) left.push_back(std::move(row));
  }
  Echelon result;
  for (std::size_t c = 0; c < columns && !left.empty(); ++c) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < left.size(); ++i) {
      if (cln::abs(left[i][c]) > cln::abs(left[best][c])) best = i;
    }
    if (cln::abs(left[best][c]) < rounding_limit()) continue;
    std::vector<cl_R> pivot = std::move(left[best]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
    const cl_R lead = pivot[c];
    for (cl_R& value : pivot) value = value / lead;
    pivot[c] = 1;
    for (std::vector<cl_R>& row : result.rows) clear(row, pivot, c);
    for (std::vector<cl_R>& row : left) clear(row, pivot, c);
    result.rows.push_back(std::move(pivot));
    result.pivots.push_back(c);
  }
  return result;
}

}  // namespace dyngen
