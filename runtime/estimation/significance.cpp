// SPDX-License-Identifier: MIT
#include "runtime/estimation/significance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/estimation/covariance.h"
#include "runtime/estimation/decompositions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<int> all_columns(const TorqueFactor& factor) {
  std::vector<int> all(static_cast<std::size_t>(factor.parameters));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// The estimate of fewer parameters as one of all; those that were left out are 0.
Estimate expanded(Estimate fit, const std::vector<int>& kept, int parameters) {
  VectorXd beta = VectorXd::Zero(parameters), scale = VectorXd::Ones(parameters);
  MatrixXd unseen = MatrixXd::Zero(parameters, fit.unseen.cols());
  std::vector<bool> is_kept(static_cast<std::size_t>(parameters), false);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    beta[kept[i]] = fit.beta[static_cast<Index>(i)];
    scale[kept[i]] = fit.scale[static_cast<Index>(i)];
    unseen.row(kept[i]) = fit.unseen.row(static_cast<Index>(i));
    is_kept[static_cast<std::size_t>(kept[i])] = true;
  }
  const Index missing = parameters - static_cast<Index>(kept.size());
  fit.unseen.resize(parameters, unseen.cols() + missing);
  fit.unseen << unseen, MatrixXd::Zero(parameters, missing);
  Index next = unseen.cols();
  for (int c = 0; c < parameters; ++c) {
    if (!is_kept[static_cast<std::size_t>(c)]) fit.unseen(c, next++) = 1;
  }
  fit.beta = beta;
  fit.scale = scale;
  return fit;
}

double weighted_squares(const TorqueFactor& factor, const VectorXd& weights, const VectorXd& beta) {
  return residual_squares(factor, beta).dot(weights.cwiseAbs2().eval());
}

Significance fitted(const TorqueFactor& factor, const VectorXd& weights, Significance result) {
  std::sort(result.kept.begin(), result.kept.end());
  result.estimate = expanded(least_squares(with_columns(factor, result.kept), weights), result.kept,
                             factor.parameters);
  return result;
}

double kept_condition(const TorqueFactor& factor, const VectorXd& weights,
                      const std::vector<int>& kept, const VectorXd& scale) {
  const TorqueFactor fewer = with_columns(factor, kept);
  VectorXd of_kept;
  if (scale.size() != 0) of_kept = scale(kept);
  return condition_number(singular_values(fewer, weights, of_kept));
}

}  // namespace

VectorXd torque_sensitivity(const TorqueFactor& factor, const VectorXd& joint_weights) {
  const StackedRows rows = stacked(factor, joint_weights);
  const double norm = rows.tau.norm();
  if (norm == 0) return VectorXd::Zero(factor.parameters);
  return (rows.W.transpose() * rows.tau).cwiseAbs() / norm;
}

VectorXd sensitivity_scale(const TorqueFactor& factor, const VectorXd& joint_weights) {
  constexpr double kLeast = 0.01;
  const VectorXd norms = column_norms(factor, joint_weights);
  VectorXd scale = torque_sensitivity(factor, joint_weights).cwiseMax(kLeast * norms);
  for (double& s : scale) s = s > 0 ? 1 / s : 1;
  return scale;
}

Significance remove_insensitive(const TorqueFactor& factor, const VectorXd& joint_weights,
                                double least) {
  const VectorXd sensitivity = torque_sensitivity(factor, joint_weights);
  Significance result;
  result.condition_before = condition_number(singular_values(factor, joint_weights, {}));
  std::vector<int> order = all_columns(factor);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return sensitivity[a] < sensitivity[b]; });
  for (const int c : order) {
    const bool low = sensitivity[c] < least * sensitivity.maxCoeff();
    (low ? result.removed : result.kept).push_back(c);
  }
  result = fitted(factor, joint_weights, std::move(result));
  result.condition_after = kept_condition(factor, joint_weights, result.kept, {});
  return result;
}

Significance remove_dependent(const TorqueFactor& factor, const VectorXd& joint_weights,
                              double most) {
  const VectorXd scale = sensitivity_scale(factor, joint_weights);
  Significance result;
  result.kept = all_columns(factor);
  result.condition_before = kept_condition(factor, joint_weights, result.kept, scale);
  for (;;) {
    const MatrixXd W = stacked(with_columns(factor, result.kept), joint_weights).W *
                       scale(result.kept).asDiagonal();
    const SingularValues svd = decomposed(W);
    result.condition_after = condition_number(svd.values);
    if (result.condition_after <= most || result.kept.size() == 1) break;
    Index worst = 0;
    svd.V.col(W.cols() - 1).cwiseAbs().maxCoeff(&worst);
    result.removed.push_back(result.kept[static_cast<std::size_t>(worst)]);
    result.kept.erase(result.kept.begin() + worst);
  }
  return fitted(factor, joint_weights, std::move(result));
}

Significance drop_weakest(const TorqueFactor& factor, const VectorXd& joint_weights,
                          int directions) {
  LeastSquaresOptions options;
  options.decomposition = Decomposition::kSvd;
  Significance result;
  result.kept = all_columns(factor);
  const Estimate full = least_squares(factor, joint_weights, options);
  result.condition_before = full.condition;
  const StackedRows rows = stacked(factor, joint_weights);
  const SingularValues svd = decomposed(rows.W * full.scale.asDiagonal());
  const Index nb = factor.parameters;
  if (directions < 0) {
    const VectorXd components = svd.U.transpose() * rows.tau;
    const VectorXd sigma = residual_deviation(factor, full.beta).cwiseProduct(joint_weights);
    const double noise = sigma.maxCoeff();
    directions = 0;
    while (directions < nb - 1 && std::abs(components[nb - 1 - directions]) < 2 * noise) {
      ++directions;
    }
  }
  options.dropped_directions = std::min(directions, static_cast<int>(nb) - 1);
  result.estimate = least_squares(factor, joint_weights, options);
  result.condition_after = condition_number(svd.values.head(nb - options.dropped_directions));
  return result;
}

Significance essential_parameters(const TorqueFactor& factor, const VectorXd& joint_weights,
                                  double ratio, double growth) {
  Significance result;
  result.kept = all_columns(factor);
  const Estimate full = least_squares(factor, joint_weights);
  result.condition_before = full.condition;
  const double allowed =
      weighted_squares(factor, joint_weights, full.beta) * (1 + growth) * (1 + growth);
  while (result.kept.size() > 1) {
    const TorqueFactor fewer = with_columns(factor, result.kept);
    const Estimate fit = least_squares(fewer, joint_weights);
    const VectorXd deviation =
        white_covariance(fewer, fit.beta, joint_weights, fit.scale, fit.unseen)
            .diagonal()
            .cwiseSqrt();
    const VectorXd relative =
        deviation.array() /
        fit.beta.array().abs().max(1e-300 + 1e-12 * fit.beta.cwiseAbs().maxCoeff());
    Index worst = 0;
    if (relative.maxCoeff(&worst) <= ratio * relative.minCoeff()) break;
    std::vector<int> without = result.kept;
    without.erase(without.begin() + worst);
    const TorqueFactor rest = with_columns(factor, without);
    const Estimate next = least_squares(rest, joint_weights);
    if (weighted_squares(rest, joint_weights, next.beta) > allowed) break;
    result.removed.push_back(result.kept[static_cast<std::size_t>(worst)]);
    result.kept = std::move(without);
  }
  result = fitted(factor, joint_weights, std::move(result));
  result.condition_after = result.estimate.condition;
  return result;
}

}  // namespace dyngen::runtime
