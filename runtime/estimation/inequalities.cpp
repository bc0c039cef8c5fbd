// SPDX-License-Identifier: MIT
#include "runtime/estimation/inequalities.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <stdexcept>
#include <vector>

#include "runtime/estimation/decompositions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Columns that may differ from 0, and the free solution over them.
class PassiveSet {
 public:
  PassiveSet(const MatrixXd& A, const VectorXd& b) : A_(A), b_(b) {}

  void add(Index column) { columns_.push_back(column); }
  /// Takes out what is not positive in x.
  void drop_zeros(const VectorXd& x) {
    std::erase_if(columns_, [&](Index column) { return !(x[column] > 0); });
  }
  [[nodiscard]] bool contains(Index column) const {
    return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
  }
  [[nodiscard]] const std::vector<Index>& columns() const { return columns_; }
  [[nodiscard]] VectorXd solution() const {
    const MatrixXd chosen = A_(Eigen::all, columns_);
    return chosen.colPivHouseholderQr().solve(b_);
  }

 private:
  const MatrixXd& A_;
  const VectorXd& b_;
  std::vector<Index> columns_;
};

/// x and the free solution z: how far from x to z until an entry becomes 0.
double longest_step(const std::vector<Index>& columns, const VectorXd& x, const VectorXd& z) {
  double step = 1;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const double from = x[columns[i]], to = z[static_cast<Index>(i)];
    if (to <= 0) step = std::min(step, from / (from - to));
  }
  return step;
}

/// Directions that A sees, as columns; the identity where it sees all.
MatrixXd seen_basis(const MatrixXd& A, double tolerance) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(A);
  // the pivots overrate the smallest singular value: a safe distance before the exact answer
  qr.setThreshold(100 * tolerance);
  if (qr.rank() == A.cols()) return MatrixXd::Identity(A.cols(), A.cols());
  const SingularValues svd = decomposed(triangle_of(A));
  const Index rank = (svd.values.array() > tolerance * svd.values[0]).count();
  return svd.V.leftCols(rank);
}

}  // namespace

NonNegativeSolution nonnegative_least_squares(const MatrixXd& A, const VectorXd& b) {
  const Index n = A.cols();
  NonNegativeSolution result{VectorXd::Zero(n), b, true};
  PassiveSet passive(A, b);
  const double small = 1e-13 * A.norm() * b.norm();
  for (Index round = 0; round < 3 * n + 10; ++round) {
    const VectorXd gradient = A.transpose() * result.residual;
    Index best = -1;
    for (Index i = 0; i < n; ++i) {
      if (passive.contains(i) || !(gradient[i] > small)) continue;
      if (best < 0 || gradient[i] > gradient[best]) best = i;
    }
    if (best < 0) return result;
    passive.add(best);
    while (!passive.columns().empty()) {
      const VectorXd z = passive.solution();
      const double step = longest_step(passive.columns(), result.x, z);
      for (std::size_t i = 0; i < passive.columns().size(); ++i) {
        double& x = result.x[passive.columns()[i]];
        x += step * (z[static_cast<Index>(i)] - x);
        // what limited the step is 0 but for rounding
        if (z[static_cast<Index>(i)] <= 0 && x < 1e-15 * result.x.norm()) x = 0;
      }
      if (step >= 1) break;
      passive.drop_zeros(result.x);
    }
    result.residual = b - A * result.x;
  }
  result.converged = false;
  return result;
}

ConstrainedSolution constrained_least_squares(const MatrixXd& A, const VectorXd& b,
                                              const Inequalities& inequalities,
                                              const VectorXd& start, double tolerance) {
  const Index n = A.cols();
  if (A.rows() != b.size() || start.size() != n ||
      (inequalities.h.size() > 0 && inequalities.G.cols() != n) ||
      inequalities.G.rows() != inequalities.h.size()) {
    throw std::invalid_argument(fmt::format(
        "constrained_least_squares(): A is {} x {}, b has {}, start {}, G is {} x {}, h has {}",
        A.rows(), n, b.size(), start.size(), inequalities.G.rows(), inequalities.G.cols(),
        inequalities.h.size()));
  }
  const VectorXd scale = unit_scale(A);
  // x = start + L y, and ||R y - d|| as small as it can be
  MatrixXd scaled(A.rows(), n + 1);
  scaled << A * scale.asDiagonal(), b - A * start;
  const MatrixXd whole = triangle_in_place(scaled);
  const MatrixXd basis = seen_basis(whole.leftCols(n), tolerance);
  const Index rank = basis.cols();
  MatrixXd reduced(n + 1, rank + 1);
  reduced << whole.leftCols(n) * basis, whole.col(n);
  const MatrixXd triangle = triangle_in_place(reduced);
  const auto R = triangle.topLeftCorner(rank, rank).triangularView<Eigen::Upper>();
  const VectorXd d = triangle.col(rank).head(rank);
  const MatrixXd L = scale.asDiagonal() * basis;
  const Index count = inequalities.h.size();
  ConstrainedSolution solution;
  solution.multipliers = VectorXd::Zero(count);
  VectorXd y = R.solve(d);
  if (count > 0) {
    // rows of unit length: one inequality is as exact as another
    MatrixXd G = inequalities.G * L;
    VectorXd h = inequalities.h - inequalities.G * start;
    VectorXd size = VectorXd::Ones(count);
    MatrixXd E(rank + 1, count);
    for (Index i = 0; i < count; ++i) {
      VectorXd row = G.row(i).transpose();
      R.transpose().solveInPlace(row);
      const double norm = row.norm();
      if (norm > 0) size[i] = 1 / norm;
      E.col(i).head(rank) = size[i] * row;
      E(rank, i) = size[i] * (h[i] - G.row(i).dot(y));
    }
    const double unit = std::max(E.row(rank).cwiseAbs().maxCoeff(), 1e-300);
    E.row(rank) /= unit;
    if (E.row(rank).maxCoeff() > 1e-12) {
      const NonNegativeSolution dual = nonnegative_least_squares(E, VectorXd::Unit(rank + 1, rank));
      const double distance = dual.residual[rank];
      solution.feasible = dual.converged && distance > 1e-12;
      if (solution.feasible) {
        // the dual's residual is f - E u; the least distance is z = E_top u / distance
        const VectorXd z = -dual.residual.head(rank) / distance * unit;
        y += R.solve(z);
        solution.multipliers = dual.x.cwiseProduct(size) * (unit / distance);
      }
    }
  }
  solution.x = start + L * y;
  return solution;
}

}  // namespace dyngen::runtime
