// SPDX-License-Identifier: MIT
#include "runtime/evidence/unknown_torque.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "runtime/estimation/matrix_products.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kFaintest = 1e-6;  // of a column's length, in one equation
constexpr double kSeen = 1e-6;      // of a column's sum of squares: columns with less stay
constexpr double kDense = 0.2;      // of all values: with more than that columns are not sparse
constexpr Index kActTogether = 32;  // columns of a basis from one equation on

/// Half of the time between equations, in samples: faster torque they do not show.
Index apart_in(const EffectRun& run) {
  return std::max<Index>(1, std::lround(static_cast<double>(run.decimator.factor) / 2));
}

/// Points of a range, spread evenly about its middle.
struct Points {
  Points(const SampleRange& range, Index apart)
      : count((range.to - range.from - 1 + apart - 1) / apart + 1),
        first(range.from - ((count - 1) * apart - (range.to - 1 - range.from)) / 2) {}
  Index count, first;
};

/// A hat about a sample behind the parallel filter, added to a column of equations.
void add_hat(const EffectRun& run, Index peak, Index apart, Eigen::Ref<Eigen::VectorXd> column) {
  const Index middle = run.decimator.taps.size() / 2;
  const Index origin = first_sample(run.decimator), factor = run.decimator.factor;
  for (Index offset = 1 - apart; offset < apart; ++offset) {
    const Index at = peak + offset;
    const double height = 1 - std::abs(static_cast<double>(offset)) / static_cast<double>(apart);
    // equations whose taps hold this sample
    if (at + middle < origin) continue;
    const Index from = std::max<Index>(0, (at - middle - origin + factor - 1) / factor);
    const Index last = std::min(column.size() - 1, (at + middle - origin) / factor);
    for (Index k = from; k <= last; ++k) {
      column[k] += height * run.decimator.taps[at - (origin + k * factor) + middle];
    }
  }
}

/// Columns of all points, whitened.
MatrixXd whitened_hats(const EffectRun& run, int joint, const Whitener& whitener) {
  const auto place = static_cast<std::size_t>(joint);
  const Index rows = run.rows.tau.rows(), apart = apart_in(run);
  if (place >= run.unknown.size()) return {rows, 0};
  Index count = 0;
  for (const SampleRange& range : run.unknown[place]) count += Points(range, apart).count;
  MatrixXd columns = MatrixXd::Zero(rows, count);
  Index column = 0;
  for (const SampleRange& range : run.unknown[place]) {
    const Points points(range, apart);
    for (Index i = 0; i < points.count; ++i, ++column) {
      add_hat(run, points.first + i * apart, apart, columns.col(column));
    }
  }
  columns = run.rows.counted.col(joint).asDiagonal() * columns;
  if (count > 0) whitener.apply(columns);
  return columns;
}

/// The first row in which a column is not 0.
Index first_that_is_not_zero(const Eigen::Ref<const MatrixXd>& columns) {
  for (Index row = 0; row < columns.rows(); ++row) {
    if ((columns.row(row).array() != 0).any()) return row;
  }
  return columns.rows();
}

}  // namespace

UnknownTorque::UnknownTorque(const EffectRun& run, int joint, const Whitener& whitener) {
  const MatrixXd hats = whitened_hats(run, joint, whitener);
  // the last point first: what it changes comes after what the others do, and so does its basis
  std::vector<Index> seen;
  for (Index c = hats.cols() - 1; c >= 0; --c) {
    if (hats.col(c).squaredNorm() > 0) seen.push_back(c);
  }
  const auto count = static_cast<Index>(seen.size());
  columns_.resize(hats.rows(), 0);
  if (count == 0) return;
  MatrixXd columns = hats(Eigen::all, seen);
  columns.colwise().normalize();
  const auto values = static_cast<double>((columns.array().abs() > kFaintest).count());
  if (values > kDense * static_cast<double>(columns.size())) {
    MatrixXd products = MatrixXd::Zero(count, count);
    products.selfadjointView<Eigen::Lower>().rankUpdate(columns.transpose());
    products.diagonal().array() += kSeen;
    const Eigen::LLT<MatrixXd> triangle(products);
    triangle.matrixU().solveInPlace<Eigen::OnTheRight>(columns);
    for (Index c = 0; c < count; c += kActTogether) {
      const auto together = columns.middleCols(c, std::min(kActTogether, count - c));
      basis_.emplace_back(together.bottomRows(together.rows() - first_that_is_not_zero(together)));
    }
    return;
  }
  columns_ = columns.sparseView(1, kFaintest);
  Eigen::SparseMatrix<double> products = columns_.transpose() * columns_;
  for (Index c = 0; c < count; ++c) products.coeffRef(c, c) += kSeen;
  products_.compute(products);
}

Index UnknownTorque::degrees() const {
  Index degrees = columns_.cols();
  for (const MatrixXd& columns : basis_) degrees += columns.cols();
  return degrees;
}

void UnknownTorque::take_out_of(Eigen::Ref<MatrixXd> rows) const {
  // of all, before any is taken out: those of points that lie close are not quite orthogonal
  std::vector<MatrixXd> inner;
  for (const MatrixXd& columns : basis_) {
    inner.push_back(transposed_product(columns, rows.bottomRows(columns.rows())));
  }
  for (std::size_t i = 0; i < basis_.size(); ++i) {
    subtract_product(basis_[i], inner[i], rows.bottomRows(basis_[i].rows()));
  }
  if (columns_.cols() > 0) {
    const MatrixXd products = columns_.transpose() * rows;
    rows -= columns_ * products_.solve(products);
  }
}

}  // namespace dyngen::runtime
