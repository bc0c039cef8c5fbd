// SPDX-License-Identifier: MIT
#include "runtime/excitation/trajectory_basis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "runtime/estimation/decompositions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kDegree = 5;
/// Control points at an end that are one: value, speed and acceleration of a clamped spline.
constexpr int kAtRest = 3;

int inner_points(const TrajectoryFamily& family) { return 2 * family.harmonics; }

TrajectoryBasis empty_basis(const VectorXd& time, int size) {
  TrajectoryBasis basis{time, MatrixXd::Zero(time.size(), size), {}, {}};
  basis.dQ = basis.ddQ = basis.Q;
  basis.Q.col(0).setOnes();
  return basis;
}

TrajectoryBasis fourier_basis(const TrajectoryFamily& family, const VectorXd& time) {
  const Index harmonics = family.harmonics;
  const VectorXd w = VectorXd::LinSpaced(harmonics, 1, static_cast<double>(harmonics)) * 2 *
                     std::numbers::pi / family.duration;
  // Terms of equal speed, sin(w_k t) / w_k: then speeds add to 0 where coefficients do.
  const MatrixXd sines = complement_of(VectorXd::Ones(harmonics).normalized());
  const MatrixXd cosines = complement_of(w.normalized());
  const MatrixXd phase = time * w.transpose();
  const MatrixXd s = phase.array().sin(), c = phase.array().cos();
  const auto over = w.cwiseInverse().asDiagonal();
  const auto times = w.asDiagonal();
  TrajectoryBasis basis = empty_basis(time, family.size());
  const Index shapes = harmonics - 1;
  basis.Q.middleCols(1, shapes) = s * over * sines;
  basis.dQ.middleCols(1, shapes) = c * sines;
  basis.ddQ.middleCols(1, shapes) = -s * times * sines;
  basis.Q.rightCols(shapes) = c * over * cosines;
  basis.dQ.rightCols(shapes) = -s * cosines;
  basis.ddQ.rightCols(shapes) = -c * times * cosines;
  return basis;
}

/// All B-splines of a degree at one time by the recursion over degrees.
/// @param knots  not falling      @return  as many as there are knots, less degree + 1
VectorXd splines_at(const std::vector<double>& knots, int degree, double time) {
  const std::size_t intervals = knots.size() - 1;
  VectorXd values = VectorXd::Zero(static_cast<Index>(intervals));
  for (std::size_t i = 0; i < intervals; ++i) {
    const bool last = time >= knots.back() && knots[i + 1] == knots.back();
    if (knots[i] < knots[i + 1] && knots[i] <= time && (time < knots[i + 1] || last)) {
      values[static_cast<Index>(i)] = 1;
    }
  }
  for (int p = 1; p <= degree; ++p) {
    for (std::size_t i = 0; i + static_cast<std::size_t>(p) < intervals; ++i) {
      const std::size_t end = i + static_cast<std::size_t>(p);
      const double rise = knots[end] - knots[i], fall = knots[end + 1] - knots[i + 1];
      const Index at = static_cast<Index>(i);
      const double up = rise > 0 ? (time - knots[i]) / rise * values[at] : 0;
      const double down = fall > 0 ? (knots[end + 1] - time) / fall * values[at + 1] : 0;
      values[at] = up + down;
    }
  }
  return values.head(static_cast<Index>(intervals) - degree);
}

/// The derivative of splines of `degree` from those of one degree less.
VectorXd raised(const std::vector<double>& knots, int degree, const VectorXd& lower) {
  VectorXd derivative(lower.size() - 1);
  for (Index i = 0; i < derivative.size(); ++i) {
    const std::size_t k = static_cast<std::size_t>(i), p = static_cast<std::size_t>(degree);
    const double rise = knots[k + p] - knots[k], fall = knots[k + p + 1] - knots[k + 1];
    derivative[i] =
        degree * ((rise > 0 ? lower[i] / rise : 0) - (fall > 0 ? lower[i + 1] / fall : 0));
  }
  return derivative;
}

TrajectoryBasis spline_basis(const TrajectoryFamily& family, const VectorXd& time) {
  const int points = inner_points(family) + 2 * kAtRest;
  std::vector<double> knots(kDegree, 0.0);
  const int intervals = points - kDegree;
  for (int i = 0; i <= intervals; ++i) knots.push_back(family.duration * i / intervals);
  knots.insert(knots.end(), kDegree, family.duration);
  TrajectoryBasis basis = empty_basis(time, family.size());
  const auto inner = Eigen::seqN(kAtRest, inner_points(family));
  const auto shapes = Eigen::seqN(1, inner_points(family));
  for (Index k = 0; k < time.size(); ++k) {
    basis.Q(k, shapes) = splines_at(knots, kDegree, time[k])(inner);
    basis.dQ(k, shapes) = raised(knots, kDegree, splines_at(knots, kDegree - 1, time[k]))(inner);
    basis.ddQ(k, shapes) = raised(
        knots, kDegree, raised(knots, kDegree - 1, splines_at(knots, kDegree - 2, time[k])))(inner);
  }
  return basis;
}

}  // namespace

void TrajectoryFamily::validate() const {
  if (!(duration > 0) || !std::isfinite(duration)) {
    throw std::invalid_argument(
        fmt::format("TrajectoryFamily: duration is {}, expected seconds above 0", duration));
  }
  if (harmonics < 2) {
    throw std::invalid_argument(fmt::format(
        "TrajectoryFamily: {} harmonics, expected at least 2 (one of them cannot begin at rest)",
        harmonics));
  }
}

int TrajectoryFamily::size() const {
  return form == TrajectoryForm::kFourier ? 1 + 2 * (harmonics - 1) : 1 + 2 * harmonics;
}

JointMotion TrajectoryBasis::motion(const MatrixXd& x) const { return {Q * x, dQ * x, ddQ * x}; }

MatrixXd TrajectoryBasis::pull_back(const JointMotion& gradient) const {
  return Q.transpose() * gradient.q + dQ.transpose() * gradient.dq + ddQ.transpose() * gradient.ddq;
}

TrajectoryBasis basis_at(const TrajectoryFamily& family, const VectorXd& time) {
  family.validate();
  return family.form == TrajectoryForm::kFourier ? fourier_basis(family, time)
                                                 : spline_basis(family, time);
}

VectorXd period_times(const TrajectoryFamily& family, Index count) {
  return VectorXd::LinSpaced(count, 0, static_cast<double>(count - 1)) * family.duration /
         static_cast<double>(count);
}

}  // namespace dyngen::runtime
