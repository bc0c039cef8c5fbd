// SPDX-License-Identifier: MIT
#include "runtime/evidence/local_reflections.h"

#include <algorithm>
#include <cmath>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDependent =
    3e-4;  // of a column's length: what is left below it is as good as nothing
constexpr double kOutside = 1e-12;  // of a column's length, in one row

/// A column and the rows in which it is not 0.
struct ShortColumn {
  VectorXd values;
  double length = 0;
  Index first = 0, last = 0;
};

std::vector<ShortColumn> short_columns(const MatrixXd& columns) {
  std::vector<ShortColumn> result;
  for (Index c = 0; c < columns.cols(); ++c) {
    ShortColumn column{columns.col(c), columns.col(c).norm()};
    if (!(column.length > 0)) continue;
    const auto is_nothing = [&](Index row) {
      return std::abs(column.values[row]) <= kOutside * column.length;
    };
    column.last = columns.rows() - 1;
    while (is_nothing(column.first)) ++column.first;
    while (is_nothing(column.last)) --column.last;
    result.push_back(std::move(column));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const ShortColumn& a, const ShortColumn& b) { return a.first < b.first; });
  return result;
}

}  // namespace

LocalReflections::LocalReflections(const MatrixXd& columns) {
  std::vector<bool> dropped(static_cast<std::size_t>(columns.rows()), false);
  for (ShortColumn& column : short_columns(columns)) {
    for (const Reflection& before : reflections_) {
      const Index end = before.first + before.normal.size() - 1;
      if (before.first > column.last || end < column.first) continue;
      reflect(before, column.values);
      column.first = std::min(column.first, before.first);
      column.last = std::max(column.last, end);
    }
    Reflection reflection;
    reflection.first = column.first;
    reflection.normal = column.values.segment(column.first, column.last - column.first + 1);
    Index target = -1;
    for (Index i = 0; i < reflection.normal.size(); ++i) {
      if (dropped[static_cast<std::size_t>(column.first + i)]) {
        reflection.normal[i] = 0;
      } else if (target < 0 ||
                 std::abs(reflection.normal[i]) > std::abs(reflection.normal[target])) {
        target = i;
      }
    }
    const double left = reflection.normal.norm();
    if (target < 0 || left <= kDependent * column.length) continue;
    reflection.dropped = column.first + target;
    reflection.normal[target] += std::copysign(left, reflection.normal[target]);
    reflection.normal.normalize();
    dropped[static_cast<std::size_t>(reflection.dropped)] = true;
    reflections_.push_back(std::move(reflection));
  }
}

void LocalReflections::reflect(const Reflection& reflection, Eigen::Ref<MatrixXd> rows) {
  auto block = rows.middleRows(reflection.first, reflection.normal.size());
  const Eigen::RowVectorXd along = reflection.normal.transpose() * block;
  block.noalias() -= (2 * reflection.normal) * along;
}

void LocalReflections::take_out_of(Eigen::Ref<MatrixXd> rows) const {
  for (const Reflection& reflection : reflections_) {
    reflect(reflection, rows);
    rows.row(reflection.dropped).setZero();
  }
}

void LocalReflections::turn_back(Eigen::Ref<MatrixXd> rows) const {
  for (auto reflection = reflections_.rbegin(); reflection != reflections_.rend(); ++reflection) {
    reflect(*reflection, rows);
  }
}

}  // namespace dyngen::runtime
