// SPDX-License-Identifier: MIT
#include "runtime/excitation/limited_trajectory.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd sought_times(const TrajectoryFamily& family) {
  constexpr Index kPerHarmonic = 40;
  return period_times(family, kPerHarmonic * family.harmonics);
}

MatrixXd parameter_units(const TrajectoryBasis& basis, const MotionLimits& limits) {
  const Index n = limits.lower.size();
  MatrixXd units(basis.Q.cols(), n);
  for (Index j = 0; j < n; ++j) {
    const double half = 0.5 * (limits.upper[j] - limits.lower[j]);
    units(0, j) = half;
    for (Index m = 1; m < basis.Q.cols(); ++m) {
      const double share =
          std::max({basis.Q.col(m).cwiseAbs().maxCoeff() / half,
                    basis.dQ.col(m).cwiseAbs().maxCoeff() / limits.speed[j],
                    basis.ddQ.col(m).cwiseAbs().maxCoeff() / limits.acceleration[j]});
      units(m, j) = 1 / share;
    }
  }
  return units;
}

MatrixXd shrunk(MatrixXd x, double factor) {
  x.bottomRows(x.rows() - 1) *= factor;
  return x;
}

MatrixXd random_trajectory(const LinearModel& model, const MotionLimits& limits,
                           const TrajectoryFamily& family, std::uint64_t seed) {
  const TrajectoryBasis basis = basis_at(family, sought_times(family));
  const MatrixXd units = parameter_units(basis, limits);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1, 1);
  constexpr int kTries = 100, kShrinks = 12;
  constexpr double kUsed = 0.98;  // what peaks between the instants may add is less
  for (int attempt = 0; attempt < kTries; ++attempt) {
    MatrixXd x(units.rows(), units.cols());
    for (Index j = 0; j < x.cols(); ++j) {
      const double middle = 0.5 * (limits.lower[j] + limits.upper[j]);
      x(0, j) = middle + 0.4 * uniform(random) * units(0, j);
      for (Index m = 1; m < x.rows(); ++m) x(m, j) = normal(random) * units(m, j);
      const Index shapes = x.rows() - 1;
      const VectorXd shape = x.col(j).tail(shapes);
      const VectorXd moved = basis.Q.rightCols(shapes) * shape;
      const double room_up = limits.upper[j] - x(0, j), room_down = x(0, j) - limits.lower[j];
      const double used = std::max(
          {moved.maxCoeff() / room_up, -moved.minCoeff() / room_down,
           (basis.dQ.rightCols(shapes) * shape).cwiseAbs().maxCoeff() / limits.speed[j],
           (basis.ddQ.rightCols(shapes) * shape).cwiseAbs().maxCoeff() / limits.acceleration[j]});
      x.col(j).tail(shapes) *= kUsed / used;
    }
    for (int shrink = 0; shrink < kShrinks; ++shrink) {
      if (limit_shares(model, limits, basis.motion(x)).largest() <= 1) return x;
      x = shrunk(x, 0.8);
    }
  }
  return {};
}

LimitShares shares_at_rate(const LinearModel& model, const MotionLimits& limits, double duration,
                           const std::function<JointMotion(const VectorXd& time)>& motion,
                           double rate) {
  // in pieces: the regressor of all instants of a long motion would fill the memory
  constexpr Index kPiece = 4096;
  const Index count = static_cast<Index>(std::ceil(duration * rate)) + 1;
  LimitShares all;
  for (Index start = 0; start < count; start += kPiece) {
    const Index piece = std::min(kPiece, count - start);
    const VectorXd time = ((VectorXd::LinSpaced(piece, 0, static_cast<double>(piece - 1)).array() +
                            static_cast<double>(start)) *
                           duration / static_cast<double>(count - 1))
                              .cwiseMin(duration);
    const LimitShares own = limit_shares(model, limits, motion(time));
    if (start == 0) {
      all = own;
      continue;
    }
    all.position = all.position.cwiseMax(own.position);
    all.speed = all.speed.cwiseMax(own.speed);
    all.acceleration = all.acceleration.cwiseMax(own.acceleration);
    all.torque = all.torque.cwiseMax(own.torque);
    all.distance = std::min(all.distance, own.distance);
  }
  return all;
}

}  // namespace dyngen::runtime
