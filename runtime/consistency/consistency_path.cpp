// SPDX-License-Identifier: MIT
#include "runtime/consistency/consistency_path.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "runtime/consistency/log_cholesky_map.h"

namespace dyngen::runtime {
namespace {

constexpr double kWeightStep = 0.1;      // of the prior, from stage to stage
constexpr int kMaxIterations = 100;      // Newton steps of a stage; usually 3 to 8
constexpr double kOnThePath = 1e-3;      // Newton decrement^2 / w: near enough to go on
constexpr double kAtTheEnd = 1e-18;      // the same, at the last stage
constexpr double kFullStepsFrom = 0.01;  // from here on full steps converge quadratically

/// Linear least squares of one Newton step, its rows ||rows dx + residual||^2.
struct Linearised {
  Eigen::MatrixXd rows;
  Eigen::VectorXd residual;
};

Linearised linearise(const ConsistencyCost& cost, const ScaledParameters& at, double weight) {
  const Eigen::Index nb = cost.A.rows(), inertial = cost.inertial_size(), na = cost.actuators();
  Linearised step{Eigen::MatrixXd::Zero(nb + inertial + na, inertial + na),
                  Eigen::VectorXd(nb + inertial + na)};
  step.rows.topRows(nb) = cost.A;
  step.residual.head(nb) = cost.A * stacked(at) - cost.b;
  for (int link = 0; link < cost.links; ++link) {
    const Eigen::Matrix4d V = at.S[static_cast<std::size_t>(link)].llt().matrixL();
    const Eigen::Matrix4d inverse =
        V.triangularView<Eigen::Lower>().solve(Eigen::Matrix4d::Identity());
    // Off-diagonal elements stand for two.
    const Eigen::Matrix<double, 10, 1> row_weight =
        log_cholesky_map::upper_elements<double>(Eigen::Matrix4d::Constant(2) -
                                                 Eigen::Matrix4d(Eigen::Matrix4d::Identity())) *
        (weight / 2);
    const Eigen::Matrix<double, 10, 1> root = row_weight.cwiseSqrt();
    const Eigen::Index first = nb + 10 * link;
    for (int element = 0; element < 10; ++element) {
      const Eigen::Matrix4d unit = log_cholesky_map::from_upper_elements<double>(
          Eigen::Matrix<double, 10, 1>::Unit(element));
      step.rows.block<10, 1>(first, 10 * link + element) = root.cwiseProduct(
          log_cholesky_map::upper_elements<double>(inverse * unit * inverse.transpose()));
    }
    const Eigen::Matrix4d gradient = V.transpose() * V - Eigen::Matrix4d::Identity();
    step.residual.segment<10>(first) =
        root.cwiseProduct(log_cholesky_map::upper_elements<double>(gradient));
  }
  step.rows.bottomRightCorner(na, na).diagonal().setConstant(std::sqrt(weight));
  step.residual.tail(na) = std::sqrt(weight) * (at.actuators - cost.prior);
  return step;
}

ScaledParameters moved(const ScaledParameters& from, const Eigen::VectorXd& dx, double t) {
  ScaledParameters to = from;
  for (std::size_t link = 0; link < to.S.size(); ++link) {
    to.S[link] += t * log_cholesky_map::from_upper_elements<double>(
                          dx.segment<10>(static_cast<Eigen::Index>(10 * link)));
  }
  to.actuators += t * dx.tail(to.actuators.size());
  return to;
}

/// The active set: actuators that are held at 0.
class Held {
 public:
  explicit Held(int actuators) : held_(static_cast<std::size_t>(actuators), false) {}

  void hold(int k) { held_[static_cast<std::size_t>(k)] = true; }
  void release(int k) { held_[static_cast<std::size_t>(k)] = false; }
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
int wants_out(const ConsistencyCost& cost, const Linearised& step, const Eigen::VectorXd& residual,
              const Held& held) {
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

/// Minimises for one weight. Returns whether Newton's decrement fell below `goal`.
bool minimise(const ConsistencyCost& cost, double weight, double goal, ScaledParameters& at,
              Held& held, int& iterations) {
  const int inertial = cost.inertial_size();
  const auto value = [&](const ScaledParameters& p) {
    return data_cost(cost, p) + weight * prior_distance(cost, p);
  };
  for (int iteration = 0; iteration < kMaxIterations; ++iteration, ++iterations) {
    const Linearised step = linearise(cost, at, weight);
    const std::vector<int> columns = held.moving(inertial);
    const Eigen::MatrixXd rows = step.rows(Eigen::all, columns);
    // Rows of very different size: QR with pivots is stable if the large ones stand first, as A's
    // do.
    const Eigen::VectorXd solution = rows.colPivHouseholderQr().solve(-step.residual);
    Eigen::VectorXd dx = Eigen::VectorXd::Zero(step.rows.cols());
    dx(columns) = solution;
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
    const double rounding = 1e-26 * step.residual.squaredNorm() + 1e-29 * cost.b.squaredNorm();
    if (decrement <= std::max(goal * weight, rounding)) {
      const int out = wants_out(cost, step, step.residual + rows * solution, held);
      if (out < 0) return true;
      held.release(out);
    }
  }
  return false;
}

}  // namespace

PathResult follow_path(const ConsistencyCost& cost) {
  PathResult result{at_prior(cost), false, 0};
  Held held(cost.actuators());
  double weight = std::max(cost.weight, cost.A.colwise().squaredNorm().maxCoeff());
  while (weight > cost.weight) {
    minimise(cost, weight, kOnThePath, result.parameters, held, result.iterations);
    weight *= kWeightStep;
  }
  result.converged =
      minimise(cost, cost.weight, kAtTheEnd, result.parameters, held, result.iterations);
  return result;
}

}  // namespace dyngen::runtime
