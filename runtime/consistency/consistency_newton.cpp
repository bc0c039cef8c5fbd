// SPDX-License-Identifier: MIT
#include "runtime/consistency/consistency_newton.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "runtime/consistency/linearised_cost.h"

namespace dyngen::runtime {
namespace {

constexpr int kMaxIterations = 100;      // usually 2 to 6
constexpr double kAtTheEnd = 1e-11;      // Newton decrement^2 / w; a full step squares it
constexpr double kFullStepsFrom = 0.01;  // from here on full steps converge quadratically

LinearisedCost linearise(const ConsistencyCost& cost, const ScaledParameters& at) {
  const Eigen::Index nb = cost.A.rows(), inertial = cost.inertial_size();
  LinearisedCost step = linearise_data(cost, at, nb + inertial + cost.actuators());
  for (int link = 0; link < cost.links; ++link) {
    const Eigen::Matrix4d V = at.S[static_cast<std::size_t>(link)].llt().matrixL();
    write_cone_rows(step, nb + 10 * link, link, cost.weight / 2,
                    V.triangularView<Eigen::Lower>().solve(Eigen::Matrix4d::Identity()),
                    V.transpose() * V - Eigen::Matrix4d::Identity());
  }
  write_actuator_rows(step, nb + inertial, cost, at);
  return step;
}

/// The active set: actuators that are held at 0.
class Held {
 public:
  explicit Held(std::vector<bool> held) : held_(std::move(held)) {}

  void hold(int k) { held_[static_cast<std::size_t>(k)] = true; }
  void release(int k) { held_[static_cast<std::size_t>(k)] = false; }
  [[nodiscard]] const std::vector<bool>& all() const { return held_; }
  [[nodiscard]] bool is_held(int k) const { return held_[static_cast<std::size_t>(k)]; }

  /// The columns of dx that may move.
  [[nodiscard]] std::vector<int> moving(int inertial) const {
    std::vector<int> columns;
    for (int k = 0; k < inertial; ++k) columns.push_back(k);
    for (int k = 0; k < static_cast<int>(held_.size()); ++k) {
      if (!is_held(k)) columns.push_back(inertial + k);
    }
    return columns;
  }

 private:
  std::vector<bool> held_;
};

/// The held actuator that the cost wants most to be positive; -1 if there is none.
int wants_out(const ConsistencyCost& cost, const LinearisedCost& step,
              const Eigen::VectorXd& residual, const Held& held) {
  int best = -1;
  double steepest = 0;
  for (int k = 0; k < cost.actuators(); ++k) {
    if (!held.is_held(k)) continue;
    const auto column = step.rows.col(cost.inertial_size() + k);
    const double slope = column.dot(residual) / column.norm();
    if (slope < steepest - 1e-12 * residual.norm()) {
      steepest = slope;
      best = k;
    }
  }
  return best;
}

bool minimise(const ConsistencyCost& cost, ScaledParameters& at, Held& held, int& iterations) {
  const double weight = cost.weight;
  const int inertial = cost.inertial_size();
  const auto value = [&](const ScaledParameters& p) {
    return data_cost(cost, p) + weight * prior_distance(cost, p);
  };
  for (int iteration = 0; iteration < kMaxIterations; ++iteration, ++iterations) {
    const LinearisedCost step = linearise(cost, at);
    const std::vector<int> columns = held.moving(inertial);
    const Eigen::MatrixXd rows = step.rows(Eigen::all, columns);
    const Eigen::VectorXd solution = rows.colPivHouseholderQr().solve(-step.residual);
    Eigen::VectorXd dx = Eigen::VectorXd::Zero(step.rows.cols());
    for (std::size_t k = 0; k < columns.size(); ++k) {
      dx[columns[k]] = solution[static_cast<Eigen::Index>(k)];
    }
    const double decrement = (rows * solution).squaredNorm();
    if (!std::isfinite(decrement)) return false;

    double longest = 1;
    int hit = -1;
    for (int k = 0; k < cost.actuators(); ++k) {
      const double change = dx[inertial + k];
      if (!cost.nonnegative[static_cast<std::size_t>(k)] || held.is_held(k)) continue;
      if (at.actuators[k] + longest * change < 0) {
        longest = at.actuators[k] / -change;
        hit = k;
      }
    }
    double t = longest;
    if (decrement > kFullStepsFrom * weight) {
      // Half the slope: a step is good if it gains a part of what the slope promises.
      const double here = value(at);
      while (t > 1e-12 && !(value(moved(at, dx, t)) <= here - 1e-4 * t * decrement)) t /= 2;
    }
    at = moved(at, dx, t);
    for (int k = 0; k < cost.actuators(); ++k) {
      if (cost.nonnegative[static_cast<std::size_t>(k)]) {
        at.actuators[k] = std::max(at.actuators[k], 0.0);
      }
    }
    if (hit >= 0 && t == longest) {
      at.actuators[hit] = 0;
      held.hold(hit);
      continue;
    }
    // Rounding of the residual sets an end to how small the decrement can become.
    const double rounding = 1e-22 * cost.b.squaredNorm();
    if (decrement <= std::max(kAtTheEnd * weight, rounding)) {
      const int out = wants_out(cost, step, step.residual + rows * solution, held);
      if (out < 0) return true;
      held.release(out);
    }
  }
  return false;
}

}  // namespace

NewtonResult minimise_by_newton(const ConsistencyCost& cost, const ScaledParameters& start,
                                const std::vector<bool>& at_zero) {
  NewtonResult result{start, {}, false, 0};
  Held held(at_zero);
  result.converged = minimise(cost, result.parameters, held, result.iterations);
  result.at_zero = held.all();
  return result;
}

}  // namespace dyngen::runtime
