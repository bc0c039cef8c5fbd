// SPDX-License-Identifier: MIT
#include "tests/baselines/column_selection.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kMostNames = 12;
constexpr double kRidge = 0.05;  // of a column's square

double criterion(double squares, double names, double equations) {
  return equations * std::log(squares / equations) + names * std::log(equations);
}

/// Places that are not 0, the largest first.
std::vector<Index> places_of(const VectorXd& x) {
  std::vector<Index> places(static_cast<std::size_t>(x.size()));
  std::iota(places.begin(), places.end(), Index{0});
  std::erase_if(places, [&](Index k) { return x[k] == 0; });
  std::stable_sort(places.begin(), places.end(),
                   [&](Index a, Index b) { return std::abs(x[a]) > std::abs(x[b]); });
  return places;
}

/// The criterion's choice of several answers.
class Best {
 public:
  explicit Best(const ColumnSet& set)
      : set_(set),
        least_(criterion(set.left.squaredNorm(), 0, set.equations)),
        x_(VectorXd::Zero(set.columns.cols())) {}

  void offer(const VectorXd& x) {
    const double names = static_cast<double>((x.array() != 0).count());
    const double value =
        criterion((set_.left - set_.columns * x).squaredNorm(), names, set_.equations);
    if (value >= least_) return;
    least_ = value;
    x_ = x;
  }
  [[nodiscard]] std::vector<Index> places() const { return places_of(x_); }

 private:
  const ColumnSet& set_;
  double least_;
  VectorXd x_;
};

/// Ridge regression on some columns of the Gram matrix; 0 elsewhere.
VectorXd solved(const MatrixXd& gram, const VectorXd& toward, const std::vector<Index>& active) {
  MatrixXd own = gram(active, active);
  own.diagonal().array() += kRidge;
  VectorXd x = VectorXd::Zero(toward.size());
  const VectorXd some = toward(active), found = own.llt().solve(some);
  x(active) = found;
  return x;
}

}  // namespace

std::vector<Index> lasso(const ColumnSet& set) {
  const MatrixXd gram = set.columns.transpose() * set.columns;
  const VectorXd toward = set.columns.transpose() * set.left;
  VectorXd x = VectorXd::Zero(toward.size());
  Best best(set);
  double penalty = toward.size() > 0 ? toward.cwiseAbs().maxCoeff() : 0;
  for (int step = 0; step < 40 && penalty > 0; ++step, penalty *= 0.85) {
    VectorXd slope = toward - gram * x;
    for (int sweep = 0; sweep < 300; ++sweep) {
      double moved = 0;
      for (Index k = 0; k < x.size(); ++k) {
        const double open = slope[k] + x[k];
        const double next = std::copysign(std::max(0.0, std::abs(open) - penalty), open);
        if (next == x[k]) continue;
        slope -= (next - x[k]) * gram.col(k);
        moved = std::max(moved, std::abs(next - x[k]));
        x[k] = next;
      }
      if (moved < 1e-6 * penalty) break;
    }
    best.offer(x);
  }
  return best.places();
}

std::vector<Index> thresholded(const ColumnSet& set) {
  if (set.columns.cols() == 0) return {};
  const MatrixXd gram = set.columns.transpose() * set.columns;
  const VectorXd toward = set.columns.transpose() * set.left;
  Best best(set);
  std::vector<Index> all(static_cast<std::size_t>(toward.size()));
  std::iota(all.begin(), all.end(), Index{0});
  const VectorXd whole = solved(gram, toward, all);
  double threshold = whole.cwiseAbs().maxCoeff();
  for (int step = 0; step < 30; ++step, threshold *= 0.8) {
    std::vector<Index> active = all;
    VectorXd x = whole;
    for (std::size_t before = 0; !active.empty() && active.size() != before;) {
      before = active.size();
      std::erase_if(active, [&](Index k) { return std::abs(x[k]) < threshold; });
      x = solved(gram, toward, active);
    }
    best.offer(x);
  }
  return best.places();
}

std::vector<Index> forward(const ColumnSet& set) {
  MatrixXd columns = set.columns;
  VectorXd left = set.left;
  std::vector<Index> chosen;
  while (chosen.size() < kMostNames && columns.cols() > 0) {
    const VectorXd gains = (columns.transpose() * left).cwiseAbs2();
    Index place = 0;
    const double gain = gains.maxCoeff(&place);
    const double before = left.squaredNorm(), after = before - gain;
    const double names = static_cast<double>(chosen.size());
    const double F = gain / (after / (set.equations - names - 1));
    const bool better =
        criterion(after, names + 1, set.equations) < criterion(before, names, set.equations);
    if (!(F > 3.84) || !better) break;  // F(1, many) at 5 %
    chosen.push_back(place);
    const VectorXd taken = columns.col(place);
    left -= taken * taken.dot(left);
    columns -= taken * (taken.transpose() * columns);
    for (Index k = 0; k < columns.cols(); ++k) {
      const double length = columns.col(k).norm();
      if (length > 1e-3) {
        columns.col(k) /= length;
      } else {
        columns.col(k).setZero();
      }
    }
  }
  return chosen;
}

}  // namespace dyngen::test
