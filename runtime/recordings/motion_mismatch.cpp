// SPDX-License-Identifier: MIT
#include "runtime/recordings/motion_mismatch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kFarthestLag =
    0.25;  // of the shorter recording: three quarters are compared at least
constexpr Index kMostCompared = 1500;  // samples: longer recordings are thinned out for the search

/// Standard deviation of white noise and rounding, from third differences (a smooth motion has
/// hardly any; noise of deviation s gives s sqrt(20)).
double noise_of(const Eigen::Ref<const Eigen::VectorXd>& x) {
  const Index n = x.size() - 3;
  if (n < 1) return 0;
  return std::sqrt(
      (x.tail(n) - 3 * x.segment(2, n) + 3 * x.segment(1, n) - x.head(n)).squaredNorm() /
      (20.0 * static_cast<double>(n)));
}

/// Positions of the moving joints times their scales, every `stride`-th row.
MatrixXd scaled(const Eigen::Ref<const MatrixXd>& q, const std::vector<MovingJoint>& moving,
                Index stride) {
  MatrixXd x((q.rows() + stride - 1) / stride, static_cast<Index>(moving.size()));
  for (std::size_t i = 0; i < moving.size(); ++i) {
    for (Index k = 0; k < x.rows(); ++k) {
      x(k, static_cast<Index>(i)) = moving[i].scale * q(k * stride, moving[i].joint);
    }
  }
  return x;
}

double mismatch_at(const MatrixXd& first, const MatrixXd& other, Index lag) {
  const Index from = std::max<Index>(0, -lag);
  const Index rows = std::min(other.rows(), first.rows() - lag) - from;
  if (rows < 1) return std::numeric_limits<double>::infinity();
  return (first.middleRows(from + lag, rows) - other.middleRows(from, rows))
             .colwise()
             .squaredNorm()
             .maxCoeff() /
         (2 * static_cast<double>(rows));
}

Index best_lag(const MatrixXd& first, const MatrixXd& other, Index from, Index to) {
  Index best = from;
  double least = std::numeric_limits<double>::infinity();
  for (Index lag = from; lag <= to; ++lag) {
    const double here = mismatch_at(first, other, lag);
    if (here >= least) continue;
    least = here;
    best = lag;
  }
  return best;
}

}  // namespace

std::vector<MovingJoint> moving_joints(const Eigen::Ref<const MatrixXd>& q) {
  constexpr double kRounding = 1e-12, kAboveNoise = 10, kAboveLargest = 1e-2;
  const MatrixXd centred = q.rowwise() - q.colwise().mean();
  const Eigen::RowVectorXd deviation =
      (centred.colwise().squaredNorm() / static_cast<double>(q.rows())).cwiseSqrt();
  std::vector<MovingJoint> moving;
  for (Index j = 0; j < q.cols(); ++j) {
    const double noise = noise_of(q.col(j));
    const double size = 1 + q.col(j).cwiseAbs().maxCoeff();
    if (deviation(j) <= kRounding * size || deviation(j) <= kAboveNoise * noise ||
        deviation(j) <= kAboveLargest * deviation.maxCoeff()) {
      continue;
    }
    const double noisy = noise / deviation(j);
    const double weight = kJustRepeats / (kJustRepeats + 4 * noisy * noisy);
    moving.push_back({j, weight, std::sqrt(weight) / deviation(j)});
  }
  return moving;
}

SameMotion compare_motions(const Eigen::Ref<const MatrixXd>& first,
                           const Eigen::Ref<const MatrixXd>& other) {
  SameMotion same;
  const Index shorter = std::min(first.rows(), other.rows());
  const std::vector<MovingJoint> moving = moving_joints(first);
  if (shorter < kFewestSamples || first.cols() != other.cols() || moving.empty()) return same;
  const auto most = static_cast<Index>(kFarthestLag * static_cast<double>(shorter));
  Index stride = (shorter + kMostCompared - 1) / kMostCompared;
  MatrixXd x = scaled(first, moving, stride), y = scaled(other, moving, stride);
  Index best = best_lag(x, y, -most / stride, most / stride);
  while (stride > 1) {
    const Index finer = std::max<Index>(1, stride / 4), reach = (stride + finer - 1) / finer;
    const Index middle = best * stride / finer;
    x = scaled(first, moving, finer);
    y = scaled(other, moving, finer);
    best = best_lag(x, y, middle - reach, middle + reach);
    stride = finer;
  }
  // between the samples the valley is a parabola
  const double left = mismatch_at(x, y, best - 1), right = mismatch_at(x, y, best + 1);
  const double middle = mismatch_at(x, y, best), bend = left - 2 * middle + right;
  const double shift = bend > 0 ? std::clamp((left - right) / (2 * bend), -0.5, 0.5) : 0;
  same.lag = static_cast<double>(best) + shift;
  same.mismatch = std::max(0.0, middle - bend * shift * shift / 2);
  return same;
}

}  // namespace dyngen::runtime
