// SPDX-License-Identifier: MIT
#include "runtime/estimation/least_squares.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "runtime/estimation/decompositions.h"
#include "runtime/estimation/posture_scale.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Equations in scaled parameters, and how many directions of these they see.
struct ScaledRows {
  MatrixXd A;
  SingularValues svd;
  int rank = 0;
};

ScaledRows scaled_rows(const MatrixXd& W, const VectorXd& scale, double tolerance) {
  ScaledRows scaled;
  scaled.A = W * scale.asDiagonal();
  scaled.svd = decomposed(scaled.A);
  const VectorXd& values = scaled.svd.values;
  const double largest = values.size() > 0 ? std::max(values[0], 1e-300) : 1;
  scaled.rank = static_cast<int>((values.array() > tolerance * largest).count());
  return scaled;
}

void check_weights(const TorqueFactor& factor, const VectorXd& joint_weights) {
  if (joint_weights.size() == static_cast<Index>(factor.joints.size()) &&
      (joint_weights.array() > 0).all() && joint_weights.allFinite()) {
    return;
  }
  throw std::invalid_argument(
      fmt::format("least_squares(): {} joint weights, expected {} positive numbers",
                  joint_weights.size(), factor.joints.size()));
}

/// The solution in scaled parameters that keeps the prior where nothing is seen.
void solve_svd(const MatrixXd& A, const VectorXd& tau, const VectorXd& prior, int rank,
               const SingularValues& svd, Estimate& estimate) {
  const VectorXd rest = svd.U.leftCols(rank).transpose() * (tau - A * prior);
  estimate.unseen = svd.V.rightCols(A.cols() - rank);
  estimate.beta = prior + svd.V.leftCols(rank) * rest.cwiseQuotient(svd.values.head(rank));
}

}  // namespace

void LeastSquaresOptions::validate(int parameters) const {
  if (prior.size() != 0 && prior.size() != parameters) {
    throw std::invalid_argument(
        fmt::format("least_squares(): prior has {} values, expected {}", prior.size(), parameters));
  }
  if (scale.size() != 0 && scale.size() != parameters) {
    throw std::invalid_argument(
        fmt::format("least_squares(): scale has {} values, expected {}", scale.size(), parameters));
  }
  if (dropped_directions < 0 || dropped_directions > parameters) {
    throw std::invalid_argument(
        fmt::format("least_squares(): {} directions to leave out, expected 0 to {}",
                    dropped_directions, parameters));
  }
}

namespace {

/// All but the condition of the equations without a scale, which takes a decomposition of its own.
Estimate solved(const TorqueFactor& factor, const VectorXd& joint_weights,
                const LeastSquaresOptions& options) {
  check_weights(factor, joint_weights);
  options.validate(factor.parameters);
  const StackedRows rows = stacked(factor, joint_weights);
  Estimate estimate;
  estimate.joint_weights = joint_weights;
  estimate.scale = options.scale.size() != 0 ? options.scale : unit_scale(rows.W);
  const Index parameters = rows.W.cols();
  ScaledRows scaled = scaled_rows(rows.W, estimate.scale, options.tolerance);
  if (scaled.rank < parameters && options.scale.size() == 0) {
    // the shortest solution takes nothing of columns that are there by the chance of a posture
    estimate.scale = scale_of_postures(estimate.scale);
    scaled = scaled_rows(rows.W, estimate.scale, options.tolerance);
  }
  const MatrixXd& A = scaled.A;
  const SingularValues& svd = scaled.svd;
  const VectorXd& singular = svd.values;
  estimate.condition = condition_number(singular);
  estimate.rank = scaled.rank;
  const bool deficient = estimate.rank < parameters;
  const int rank =
      std::min(estimate.rank, static_cast<int>(parameters) - options.dropped_directions);

  if (options.decomposition == Decomposition::kQr && !deficient && rank == parameters) {
    estimate.beta = least_norm_solution(A, rows.tau).col(0);
    estimate.unseen = MatrixXd::Zero(parameters, 0);
  } else {
    const VectorXd prior = options.prior.size() != 0
                               ? options.prior.cwiseQuotient(estimate.scale).eval()
                               : VectorXd::Zero(parameters);
    solve_svd(A, rows.tau, prior, rank, svd, estimate);
  }
  estimate.beta = estimate.beta.cwiseProduct(estimate.scale);
  if (deficient) {
    estimate.status = EstimateStatus::kRankDeficient;
    estimate.message = fmt::format("{} of {} combinations of parameters are not seen in the data",
                                   parameters - estimate.rank, parameters);
  }
  estimate.rank = rank;
  const VectorXd squares = residual_squares(factor, estimate.beta);
  estimate.residual_rms.resize(squares.size());
  for (Index j = 0; j < squares.size(); ++j) {
    const double count = factor.joints[static_cast<std::size_t>(j)].rows;
    estimate.residual_rms[j] = count > 0 ? std::sqrt(squares[j] / count) : 0;
  }
  return estimate;
}

}  // namespace

Estimate least_squares(const TorqueFactor& factor, const VectorXd& joint_weights,
                       const LeastSquaresOptions& options) {
  Estimate estimate = solved(factor, joint_weights, options);
  estimate.raw_condition = condition_number(singular_values(factor, joint_weights, {}));
  return estimate;
}

VectorXd residual_deviation(const TorqueFactor& factor, const VectorXd& beta) {
  VectorXd deviation = residual_squares(factor, beta);
  const VectorXd torque = torque_squares(factor);
  for (Index j = 0; j < deviation.size(); ++j) {
    const std::size_t k = static_cast<std::size_t>(j);
    const double count = factor.joints[k].rows;
    const double degrees = count - static_cast<double>(factor.columns[k].size());
    if (!(torque[j] > 0)) {
      deviation[j] = 1;
    } else if (degrees < 1) {
      deviation[j] = std::sqrt(torque[j] / count);
    } else {
      // a fit without a residual would give an infinite weight
      deviation[j] = std::sqrt(std::max(deviation[j], 1e-24 * torque[j]) / degrees);
    }
  }
  return deviation;
}

Estimate weighted_least_squares(const TorqueFactor& factor, const LeastSquaresOptions& options) {
  constexpr int kMostRounds = 30;
  VectorXd weights = VectorXd::Ones(static_cast<Index>(factor.joints.size()));
  Estimate estimate = solved(factor, weights, options);
  for (int round = 0; round < kMostRounds; ++round) {
    const VectorXd next = residual_deviation(factor, estimate.beta).cwiseInverse();
    const double change = ((next - weights).array() / next.array()).abs().maxCoeff();
    weights = next;
    estimate = solved(factor, weights, options);
    if (change < 1e-8) break;
  }
  estimate.raw_condition = condition_number(singular_values(factor, weights, {}));
  return estimate;
}

TorqueFactor with_columns(const TorqueFactor& factor, const std::vector<int>& kept) {
  std::vector<int> place(static_cast<std::size_t>(factor.parameters), -1);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    place[static_cast<std::size_t>(kept[i])] = static_cast<int>(i);
  }
  TorqueFactor fewer;
  fewer.parameters = static_cast<int>(kept.size());
  for (std::size_t j = 0; j < factor.joints.size(); ++j) {
    const MatrixXd& R = factor.joints[j].R;
    std::vector<int> columns;
    std::vector<Index> sources;
    for (std::size_t i = 0; i < factor.columns[j].size(); ++i) {
      const int to = place[static_cast<std::size_t>(factor.columns[j][i])];
      if (to < 0) continue;
      columns.push_back(to);
      sources.push_back(static_cast<Index>(i));
    }
    sources.push_back(R.cols() - 1);
    MatrixXd A = R(Eigen::all, sources);
    JointFactor joint{MatrixXd::Zero(A.cols(), A.cols()), 0};
    absorb(joint, A);
    joint.rows = factor.joints[j].rows;
    fewer.columns.push_back(std::move(columns));
    fewer.joints.push_back(std::move(joint));
  }
  return fewer;
}

VectorXd singular_values(const TorqueFactor& factor, const VectorXd& joint_weights,
                         const VectorXd& scale) {
  MatrixXd W = stacked(factor, joint_weights).W;
  if (scale.size() != 0) W *= scale.asDiagonal();
  return singular_values(W);
}

double condition_number(const VectorXd& singular) {
  if (singular.size() == 0) return 1;
  const double smallest = singular[singular.size() - 1];
  if (smallest <= 0) return std::numeric_limits<double>::infinity();
  return singular[0] / smallest;
}

}  // namespace dyngen::runtime
