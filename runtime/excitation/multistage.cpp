// SPDX-License-Identifier: MIT
#include "runtime/excitation/multistage.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "runtime/excitation/information.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
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

}  // namespace

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
