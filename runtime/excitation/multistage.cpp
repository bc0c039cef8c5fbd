// SPDX-License-Identifier: MIT
#include "runtime/excitation/multistage.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "runtime/excitation/information.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// R is the mean over the samples.
InformationOptions mean_information(const std::vector<int>& parameters) {
  InformationOptions options;
  options.parameters = parameters;
  options.samples = 1;
  return options;
}

/// 1 / sigma of R's smallest singular value, which is its smallest eigenvalue.
struct InverseSmallest {
  double value = 0;
  VectorXd direction;
};

InverseSmallest inverse_smallest(const MatrixXd& R) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(R);
  return {1 / std::max(solver.eigenvalues()[0], 1e-300), solver.eigenvectors().col(0)};
}

/// Q of Bryson's rule for every joint.
VectorXd acceleration_weights(const MotionLimits& limits, const MatrixXd& u, double cost,
                              double share) {
  VectorXd Q(u.cols());
  for (Index j = 0; j < u.cols(); ++j) {
    // without a limit: what the start uses
    const double largest = std::isfinite(limits.acceleration[j])
                               ? limits.acceleration[j]
                               : std::max(u.col(j).cwiseAbs().maxCoeff(), 1e-6);
    Q[j] = share * cost / (static_cast<double>(u.rows()) * largest * largest);
  }
  return Q;
}

double acceleration_cost(const MatrixXd& u, const VectorXd& Q) { return (u.cwiseAbs2() * Q).sum(); }

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
    const RowVectorXd ddx = w_ * w_ * (target - x_) - 2 * w_ * dx_;
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
  const MatrixXd R = information_of(model, motion, mean_information(parameters)).R;
  return {motion.q, R.colwise().norm().minCoeff()};
}

}  // namespace

JointMotion HeldAccelerations::motion() const {
  const double T = sample_time;
  JointMotion motion{MatrixXd(u.rows(), u.cols()), MatrixXd(u.rows(), u.cols()), u};
  RowVectorXd q = start.transpose(), dq = RowVectorXd::Zero(u.cols());
  for (Index k = 0; k < u.rows(); ++k) {
    motion.q.row(k) = q;
    motion.dq.row(k) = dq;
    q += T * dq + 0.5 * T * T * u.row(k);
    dq += T * u.row(k);
  }
  return motion;
}

MatrixXd adjoint_sweep(const JointMotion& partial, double sample_time) {
  const double T = sample_time;
  MatrixXd gradient(partial.q.rows(), partial.q.cols());
  RowVectorXd by_q = RowVectorXd::Zero(partial.q.cols()), by_dq = by_q;
  for (Index k = partial.q.rows() - 1; k >= 0; --k) {
    gradient.row(k) = partial.ddq.row(k) + 0.5 * T * T * by_q + T * by_dq;
    by_dq += T * by_q + partial.dq.row(k);
    by_q += partial.q.row(k);
  }
  return gradient;
}

HeldAccelerations resampled(const HeldAccelerations& trajectory, int parts) {
  HeldAccelerations fine = trajectory;
  fine.sample_time /= parts;
  fine.u.resize(trajectory.u.rows() * parts, trajectory.u.cols());
  for (Index k = 0; k < fine.u.rows(); ++k) fine.u.row(k) = trajectory.u.row(k / parts);
  return fine;
}

std::optional<HeldAccelerations> brought_to_rest(const LinearModel& model,
                                                 const MotionLimits& limits,
                                                 const HeldAccelerations& trajectory) {
  const double T = trajectory.sample_time;
  const Index samples = trajectory.u.rows(), n = trajectory.u.cols();
  const JointMotion motion = trajectory.motion();
  const Index step = std::max<Index>(1, samples / 50);
  for (Index kept = samples; kept >= samples / 2 && kept > 0; kept -= step) {
    const RowVectorXd speed = motion.dq.row(kept - 1) + T * trajectory.u.row(kept - 1);
    for (int tenths = 1; tenths <= 30; ++tenths) {
      const Index braking = std::max<Index>(1, std::lround(0.1 * tenths / T));
      HeldAccelerations whole = trajectory;
      // one more sample stands still: the motion's last row is then at rest
      whole.u.conservativeResize(kept + braking + 1, n);
      whole.u.middleRows(kept, braking).rowwise() = -speed / (T * static_cast<double>(braking));
      whole.u.row(kept + braking).setZero();
      if (limit_shares(model, limits, whole.motion()).largest() <= 1) return whole;
    }
  }
  return std::nullopt;
}

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

MultistageResult multistage(const LinearModel& model, const MotionLimits& limits,
                            const HeldAccelerations& start, const MultistageOptions& options) {
  limits.validate(model);
  if (start.u.cols() != model.joints() || start.start.size() != model.joints()) {
    throw std::invalid_argument(fmt::format("multistage(): start of {} joints, expected {}",
                                            start.u.cols(), model.joints()));
  }
  const InformationOptions asked = mean_information(options.parameters);
  asked.validate(model);
  MultistageResult result;
  result.trajectory = start;
  JointMotion motion = start.motion();
  result.shares = limit_shares(model, limits, motion);
  if (result.shares.largest() > 1) {
    throw std::invalid_argument(
        fmt::format("multistage(): the start uses {:.3f} of a limit, expected at most 1",
                    result.shares.largest()));
  }
  Information information = information_of(model, motion, asked);
  InverseSmallest smallest = inverse_smallest(information.R);
  result.cost.push_back(smallest.value);
  const VectorXd Q =
      acceleration_weights(limits, start.u, smallest.value, options.acceleration_share);
  double change = options.first_change;
  constexpr int kHalvings = 20;
  const auto begin = std::chrono::steady_clock::now();
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - begin;
    if (gone.count() > options.seconds) {
      result.ended = fmt::format("after {} iterations: the time is over", iteration);
      return result;
    }
    const MatrixXd& u = result.trajectory.u;
    const double J = smallest.value + acceleration_cost(u, Q);
    const MatrixXd G =
        -smallest.value * smallest.value * smallest.direction * smallest.direction.transpose();
    JointMotion partial = information_gradient(model, motion, asked, information, G);
    partial.ddq += 2 * u * Q.asDiagonal();
    const MatrixXd gradient = adjoint_sweep(partial, result.trajectory.sample_time);
    const double largest = gradient.cwiseAbs().maxCoeff();
    bool accepted = false, limited = false;
    for (int halving = 0; halving < kHalvings && !accepted && largest > 0; ++halving) {
      HeldAccelerations trial = result.trajectory;
      trial.u -= change / largest * gradient;
      const JointMotion moved = trial.motion();
      const LimitShares shares = limit_shares(model, limits, moved);
      limited = shares.largest() > 1;
      if (!limited) {
        Information own = information_of(model, moved, asked);
        const InverseSmallest value = inverse_smallest(own.R);
        if (value.value + acceleration_cost(trial.u, Q) < J) {
          result.trajectory = std::move(trial);
          result.shares = shares;
          motion = moved;
          information = std::move(own);
          smallest = value;
          accepted = true;
        }
      }
      change *= accepted ? 1.5 : 0.5;
    }
    if (!accepted) {
      result.ended = limited ? "no step keeps the limits" : "no step lowers the cost";
      return result;
    }
    result.cost.push_back(smallest.value);
  }
  result.ended = fmt::format("{} iterations", options.iterations);
  return result;
}

}  // namespace dyngen::runtime
