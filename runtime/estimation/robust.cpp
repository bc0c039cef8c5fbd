// SPDX-License-Identifier: MIT
#include "runtime/estimation/robust.h"

#include <cmath>

namespace dyngen::runtime {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Mean of min(x^2, c^2) for a standard normal x: what proposal 2 divides by.
double clipped_variance(double c) {
  const double density = std::exp(-0.5 * c * c) / std::sqrt(2 * 3.14159265358979323846);
  const double tails = std::erfc(c / std::sqrt(2.0));
  return (1 - tails) - 2 * c * density + c * c * tails;
}

/// The square roots of the weights of a block's equations.
MatrixXd root_weights(const MatrixXd& rest, const VectorXd& deviation, double threshold) {
  MatrixXd weights(rest.rows(), rest.cols());
  for (Index j = 0; j < rest.cols(); ++j) {
    const double limit = threshold * deviation[j];
    weights.col(j) = (limit / rest.col(j).array().abs().max(1e-300)).min(1.0).sqrt();
  }
  return weights;
}

/// A block whose equations are multiplied by the roots of their weights.
RowBlock weighted(const RowBlock& block, const MatrixXd& roots) {
  RowBlock result = block;
  const Index nb = block.Y.cols() / roots.cols();
  for (Index j = 0; j < roots.cols(); ++j) {
    result.Y.middleCols(j * nb, nb).array().colwise() *= roots.col(j).array();
  }
  result.tau.array() *= roots.array();
  return result;
}

}  // namespace

RobustEstimate iteratively_reweighted(const RowSource& source,
                                      const std::vector<std::vector<int>>& columns, int parameters,
                                      const RobustOptions& options) {
  const double expected = clipped_variance(options.threshold);
  RobustEstimate result;
  result.factor = factor_of(source, columns, parameters);
  result.estimate = weighted_least_squares(result.factor);
  result.deviation = residual_deviation(result.factor, result.estimate.beta);
  VectorXd samples(result.deviation.size());
  for (Index j = 0; j < samples.size(); ++j) {
    samples[j] = std::max(1.0, result.factor.joints[static_cast<std::size_t>(j)].rows);
  }

  for (result.rounds = 1; result.rounds <= options.most_rounds; ++result.rounds) {
    const VectorXd beta = result.estimate.beta, deviation = result.deviation;
    TorqueFactor factor = empty_factor(columns, parameters);
    VectorXd clipped = VectorXd::Zero(deviation.size());
    result.downweighted = VectorXd::Zero(deviation.size());
    source([&](const RowBlock& block) {
      const MatrixXd rest = residual(block, beta);
      const MatrixXd weights = root_weights(rest, deviation, options.threshold);
      absorb(factor, weighted(block, weights));
      for (Index j = 0; j < rest.cols(); ++j) {
        const double limit = options.threshold * deviation[j];
        clipped[j] += rest.col(j).array().abs().min(limit).square().sum();
        result.downweighted[j] += static_cast<double>((rest.col(j).array().abs() > limit).count());
      }
    });
    result.downweighted.array() /= samples.array();
    for (Index j = 0; j < clipped.size(); ++j) {
      const double degrees = std::max(
          1.0, samples[j] - static_cast<double>(columns[static_cast<std::size_t>(j)].size()));
      result.deviation[j] = std::sqrt(std::max(clipped[j], 1e-300) / (degrees * expected));
    }
    result.factor = std::move(factor);
    result.estimate = least_squares(result.factor, result.deviation.cwiseInverse());
    const double moved = (result.estimate.beta - beta).cwiseQuotient(result.estimate.scale).norm() /
                         result.estimate.beta.cwiseQuotient(result.estimate.scale).norm();
    const double rescaled =
        ((result.deviation - deviation).array() / deviation.array()).abs().maxCoeff();
    if (std::max(moved, rescaled) < options.tolerance) break;
  }
  result.rounds = std::min(result.rounds, options.most_rounds);
  const VectorXd beta = result.estimate.beta, deviation = result.deviation;
  result.rows = [source, beta, deviation,
                 threshold = options.threshold](const std::function<void(const RowBlock&)>& visit) {
    source([&](const RowBlock& block) {
      visit(weighted(block, root_weights(residual(block, beta), deviation, threshold)));
    });
  };
  return result;
}

}  // namespace dyngen::runtime
