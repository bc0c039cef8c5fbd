// SPDX-License-Identifier: MIT
#include "runtime/excitation/multistage.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
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

/// 1 / sigma of R's smallest singular value, and what stands for it.
struct InverseSmallest {
  double value = 0;
  double smooth = 0;
  MatrixXd gradient;  ///< of smooth, by R
};

InverseSmallest inverse_smallest(const MatrixXd& R, double power) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(R);
  const Eigen::ArrayXd lambda = solver.eigenvalues().array().max(1e-300);
  const MatrixXd& V = solver.eigenvectors();
  InverseSmallest result;
  result.value = 1 / lambda[0];
  // (sum lambda^-p)^(1/p), each over the smallest first: numbers of every size
  Eigen::ArrayXd weights = Eigen::ArrayXd::Zero(lambda.size());
  weights[0] = 1;
  if (std::isfinite(power)) weights = (lambda[0] / lambda).pow(power);
  const double sum = weights.sum();
  result.smooth = result.value * (std::isfinite(power) ? std::pow(sum, 1 / power) : 1);
  result.gradient =
      -result.smooth * V * (weights / (sum * lambda)).matrix().asDiagonal() * V.transpose();
  return result;
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

/// A trajectory and all that is asked of it.
struct State {
  HeldAccelerations trajectory;
  JointMotion motion;
  LimitShares shares;
  Information information;
  InverseSmallest smallest;
  MotionConstraints constraints;  ///< without a barrier: none
  double total = 0;               ///< what is minimised; infinite outside of the limits
};

/// The cost and its gradient.
class Descent {
 public:
  Descent(const LinearModel& model, const MotionLimits& limits, const HeldAccelerations& start,
          const MultistageOptions& options)
      : model_(model),
        limits_(limits),
        asked_(mean_information(options.parameters)),
        power_(options.power) {
    asked_.validate(model);
    const double cost =
        inverse_smallest(information_of(model, start.motion(), asked_).R, power_).value;
    barrier_ = options.barrier_share * cost;
    Q_ = acceleration_weights(limits, start.u, cost, options.acceleration_share);
  }

  [[nodiscard]] State at(const HeldAccelerations& trajectory) const {
    State state;
    state.trajectory = trajectory;
    state.motion = trajectory.motion();
    state.shares = limit_shares(model_, limits_, state.motion);
    state.total = std::numeric_limits<double>::infinity();
    if (state.shares.largest() > 1) return state;
    state.information = information_of(model_, state.motion, asked_);
    state.smallest = inverse_smallest(state.information.R, power_);
    state.total = state.smallest.smooth + acceleration_cost(trajectory.u, Q_);
    if (barrier_ > 0) {
      state.constraints = constraints_of(model_, limits_, state.motion, kSharpness);
      state.total += barrier_ * barrier_values(state.constraints).sum();
    }
    return state;
  }

  /// By the accelerations, (K x n).
  [[nodiscard]] MatrixXd gradient(const State& state) const {
    JointMotion partial = information_gradient(model_, state.motion, asked_, state.information,
                                               state.smallest.gradient);
    partial.ddq += 2 * state.trajectory.u * Q_.asDiagonal();
    for (std::size_t c = 0; c < state.constraints.by_motion.size(); ++c) {
      const double value = state.constraints.values[static_cast<Index>(c)];
      const double slope = barrier_ / std::max(kTouching, -value);
      const JointMotion& own = state.constraints.by_motion[c];
      if (own.q.size() > 0) partial.q += slope * own.q;
      if (own.dq.size() > 0) partial.dq += slope * own.dq;
      if (own.ddq.size() > 0) partial.ddq += slope * own.ddq;
    }
    return adjoint_sweep(partial, state.trajectory.sample_time);
  }

 private:
  /// Of the constraints: within log(samples) / 300 of the largest share.
  static constexpr double kSharpness = 300;
  /// A constraint is above the largest share: where it is passed, the limit itself may be kept.
  /// From here on the barrier is a straight line.
  static constexpr double kTouching = 1e-3;

  static Eigen::ArrayXd barrier_values(const MotionConstraints& constraints) {
    return constraints.values.unaryExpr([](double c) {
      return -c > kTouching ? -std::log(-c) : -std::log(kTouching) + (c + kTouching) / kTouching;
    });
  }

  const LinearModel& model_;
  const MotionLimits& limits_;
  InformationOptions asked_;
  double power_;
  double barrier_ = 0;
  VectorXd Q_;
};

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
  const Descent descent(model, limits, start, options);
  State state = descent.at(start);
  if (state.shares.largest() > 1) {
    throw std::invalid_argument(
        fmt::format("multistage(): the start uses {:.3f} of a limit, expected at most 1",
                    state.shares.largest()));
  }
  MultistageResult result;
  const auto note = [&] {
    result.cost.push_back(state.smallest.value);
    result.total.push_back(state.total);
  };
  note();
  const auto finished = [&](const std::string& why) {
    result.trajectory = state.trajectory;
    result.shares = state.shares;
    result.ended = why;
    return result;
  };
  double change = options.first_change;
  constexpr int kHalvings = 20;
  const auto begin = std::chrono::steady_clock::now();
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - begin;
    if (gone.count() > options.seconds) {
      return finished(fmt::format("after {} iterations: the time is over", iteration));
    }
    const MatrixXd gradient = descent.gradient(state);
    const double largest = gradient.cwiseAbs().maxCoeff();
    bool accepted = false, limited = false;
    for (int halving = 0; halving < kHalvings && !accepted && largest > 0; ++halving) {
      HeldAccelerations trial = state.trajectory;
      trial.u -= change / largest * gradient;
      State moved = descent.at(trial);
      limited = moved.shares.largest() > 1;
      accepted = !limited && moved.total < state.total;
      if (accepted) state = std::move(moved);
      change *= accepted ? 1.5 : 0.5;
    }
    if (!accepted)
      return finished(limited ? "no step keeps the limits" : "no step lowers the cost");
    note();
  }
  return finished(fmt::format("{} iterations", options.iterations));
}

}  // namespace dyngen::runtime
