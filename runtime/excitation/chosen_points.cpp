// SPDX-License-Identifier: MIT
#include "runtime/excitation/chosen_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <stdexcept>

#include "runtime/excitation/information.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;

/// One critically damped pole pair, twice: the way to a point, then the filter.
class SecondOrder {
 public:
  SecondOrder(double w, double sample_time) : w_(w), T_(sample_time) {}
  /// @return  the acceleration with which x goes towards `target` in the next sample
  RowVectorXd step(const RowVectorXd& target) {
    if (x_.size() == 0) {
      x_ = target * 0;
      dx_ = x_;
    }
    RowVectorXd ddx = w_ * w_ * (target - x_) - 2 * w_ * dx_;
    x_ += T_ * dx_ + 0.5 * T_ * T_ * ddx;
    dx_ += T_ * ddx;
    return ddx;
  }

  [[nodiscard]] const RowVectorXd& value() const { return x_; }

 private:
  double w_, T_;
  RowVectorXd x_, dx_;
};

/// Random postures, (points x n); their worst parameter is how well |R e_m| is in the least seen.
struct PointSet {
  MatrixXd q;
  double worst = -1;
};

PointSet random_points(const LinearModel& model, const MotionLimits& limits,
                       const std::vector<int>& parameters, const ChosenPointsOptions& options,
                       std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Index n = limits.lower.size();
  JointMotion motion;
  motion.q.resize(options.points, n);
  motion.dq = motion.ddq = motion.q;
  const double w = 2 * std::numbers::pi * options.bandwidth_hz;
  for (Index i = 0; i < options.points; ++i) {
    for (Index j = 0; j < n; ++j) {
      const double half = 0.5 * options.share * (limits.upper[j] - limits.lower[j]);
      motion.q(i, j) = 0.5 * (limits.lower[j] + limits.upper[j]) + half * uniform(random);
      // what the way to the point passes through
      motion.dq(i, j) = w * half * uniform(random);
      motion.ddq(i, j) = w * w * half * uniform(random);
    }
  }
  const MatrixXd R = information_of(model, motion, {.parameters = parameters}).R;
  return {motion.q, R.colwise().norm().minCoeff()};
}

}  // namespace

HeldAccelerations through_chosen_points(const LinearModel& model, const MotionLimits& limits,
                                        const std::vector<int>& parameters,
                                        const ChosenPointsOptions& options) {
  limits.validate(model);
  if (options.samples < 2 || options.points < 1 || options.candidates < 1 ||
      !(options.sample_time > 0) || !(options.bandwidth_hz > 0) || !(options.share > 0)) {
    throw std::invalid_argument(fmt::format(
        "through_chosen_points(): {} samples, {} points, {} candidates, {} s, {} Hz, share {}; "
        "expected at least 2, 1, 1, and more than 0",
        options.samples, options.points, options.candidates, options.sample_time,
        options.bandwidth_hz, options.share));
  }
  std::mt19937_64 random(options.seed);
  PointSet best;
  for (int i = 0; i < options.candidates; ++i) {
    PointSet set = random_points(model, limits, parameters, options, random);
    if (set.worst > best.worst) best = std::move(set);
  }
  HeldAccelerations trajectory{.sample_time = options.sample_time,
                               .start = 0.5 * (limits.lower + limits.upper)};
  trajectory.u.resize(options.samples, limits.lower.size());
  const double w = 2 * std::numbers::pi * options.bandwidth_hz;
  SecondOrder way(w, options.sample_time), filter(w, options.sample_time);
  for (Index k = 0; k < options.samples; ++k) {
    const Index point = std::min<Index>(options.points - 1, k * options.points / options.samples);
    way.step(best.q.row(point) - trajectory.start.transpose());
    trajectory.u.row(k) = filter.step(way.value());
  }
  // torque and box may not allow what the ranges do
  for (int shrink = 0; shrink < 30; ++shrink) {
    if (limit_shares(model, limits, trajectory.motion()).largest() < 0.95) break;
    trajectory.u *= 0.9;
  }
  return trajectory;
}

}  // namespace dyngen::runtime
