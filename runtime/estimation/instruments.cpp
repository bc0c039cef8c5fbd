// SPDX-License-Identifier: MIT
#include "runtime/estimation/instruments.h"

#include <algorithm>
#include <cmath>

#include "runtime/estimation/covariance.h"
#include "runtime/estimation/decompositions.h"
#include "runtime/estimation/distributions.h"
#include "runtime/estimation/noise_model.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Parameters twice: first those of one matrix, then those of another.
std::vector<std::vector<int>> doubled(const std::vector<std::vector<int>>& columns,
                                      int parameters) {
  std::vector<std::vector<int>> both = columns;
  for (std::vector<int>& of_joint : both) {
    const std::size_t count = of_joint.size();
    for (std::size_t i = 0; i < count; ++i) of_joint.push_back(of_joint[i] + parameters);
  }
  return both;
}

/// [first, second] joint by joint.
MatrixXd side_by_side(const MatrixXd& first, const MatrixXd& second, int parameters) {
  const Index joints = first.cols() / parameters;
  MatrixXd both(first.rows(), 2 * first.cols());
  for (Index j = 0; j < joints; ++j) {
    both.middleCols(2 * j * parameters, parameters) = first.middleCols(j * parameters, parameters);
    both.middleCols((2 * j + 1) * parameters, parameters) =
        second.middleCols(j * parameters, parameters);
  }
  return both;
}

RowSource paired_rows(const InstrumentSource& source, int parameters) {
  return [source, parameters](const std::function<void(const RowBlock&)>& visit) {
    source([&](const InstrumentBlock& block) {
      visit({side_by_side(block.Z, block.rows.Y, parameters), block.rows.tau, block.rows.counted,
             block.rows.continues_run});
    });
  };
}

/// Durbin, Wu and Hausman by the difference of both estimates, whose covariance is that of the
/// noise in both: d = [(Z'W)^-1 Z' - (W'W)^-1 W'] e.
/// @param ZW, WW  of scaled columns  @param scales  (2 nb) of Z's columns, then of W's
void test_exogeneity(const InstrumentSource& source, const std::vector<std::vector<int>>& columns,
                     const MatrixXd& ZW, const MatrixXd& W, const VectorXd& tau,
                     const VectorXd& z_scale, InstrumentalEstimate& result) {
  constexpr double kSame = 1e-9;  // of the largest variance: directions in which both are the same
  const Estimate& estimate = result.estimate;
  const Index nb = W.cols();
  const RowSource rows = [source, nb, beta = estimate.beta](const auto& visit) {
    source([&](const InstrumentBlock& block) {
      visit({side_by_side(block.Z, block.rows.Y, static_cast<int>(nb)), residual(block.rows, beta),
             block.rows.counted, block.rows.continues_run});
    });
  };
  const auto both = doubled(columns, static_cast<int>(nb));
  const NoiseFactor noise = noise_factor(rows, both, VectorXd::Zero(2 * nb));
  VectorXd scales(2 * nb);
  scales << z_scale, estimate.scale;
  const MatrixXd noisy = noise_rows(noise, both, static_cast<int>(2 * nb), estimate.joint_weights) *
                         scales.asDiagonal();
  MatrixXd difference(nb, 2 * nb);
  difference << pseudo_inverse(ZW), -pseudo_inverse(W.transpose() * W);
  const MatrixXd spread = noisy * difference.transpose();
  const VectorXd plain = least_norm_solution(W, tau).col(0);
  const VectorXd moved = estimate.beta.cwiseQuotient(estimate.scale) - plain;
  const SingularValues svd = decomposed(spread.transpose());
  const VectorXd along = svd.U.transpose() * moved;
  for (Index i = 0; i < along.size(); ++i) {
    if (svd.values[i] <= std::sqrt(kSame) * svd.values[0] || svd.values[i] == 0) break;
    result.hausman += std::pow(along[i] / svd.values[i], 2);
    ++result.degrees;
  }
  if (result.degrees > 0) result.p_value = chi_square_tail(result.hausman, result.degrees);
  const VectorXd deviation =
      estimate.covariance.diagonal().cwiseMax(0).cwiseSqrt().cwiseQuotient(estimate.scale);
  for (Index i = 0; i < nb; ++i) {
    if (deviation[i] > 0) {
      result.largest_move = std::max(result.largest_move, std::abs(moved[i]) / deviation[i]);
    }
  }
}

}  // namespace

InstrumentalEstimate instrumental_variables(const InstrumentSource& source,
                                            const std::vector<std::vector<int>>& columns,
                                            int parameters, const VectorXd& joint_weights) {
  const TorqueFactor pairs =
      factor_of(paired_rows(source, parameters), doubled(columns, parameters), 2 * parameters);
  const StackedRows rows = stacked(pairs, joint_weights);
  const Index nb = parameters;
  const VectorXd z_scale = unit_scale(rows.W.leftCols(nb));
  const VectorXd scale = unit_scale(rows.W.rightCols(nb));
  // [Z W tau] = Q R: Z'(tau - W beta) = 0 becomes R_ZW beta = R_Ztau
  MatrixXd all(rows.W.rows(), 2 * nb + 1);
  all << rows.W.leftCols(nb) * z_scale.asDiagonal(), rows.W.rightCols(nb) * scale.asDiagonal(),
      rows.tau;
  const MatrixXd R = triangle_in_place(all).topRows(nb);
  const MatrixXd R_ZW = R.middleCols(nb, nb);
  const SingularValues svd = decomposed(R_ZW);

  InstrumentalEstimate result;
  Estimate& estimate = result.estimate;
  estimate.joint_weights = joint_weights;
  estimate.scale = scale;
  estimate.beta = scale.cwiseProduct(least_norm_solution(R_ZW, R.rightCols(1)).col(0));
  estimate.rank = static_cast<int>((svd.values.array() > 1e-9 * svd.values[0]).count());
  estimate.unseen = svd.V.rightCols(nb - estimate.rank);
  if (estimate.rank < nb) {
    estimate.status = EstimateStatus::kRankDeficient;
    estimate.message = "instruments do not see all parameters";
  }
  const MatrixXd W = rows.W.rightCols(nb) * scale.asDiagonal();
  estimate.condition = condition_number(singular_values(W));
  estimate.raw_condition = condition_number(singular_values(rows.W.rightCols(nb)));
  const MatrixXd cosines = least_norm_solution(triangle_of(W).transpose(), R_ZW.transpose());
  result.relevance = singular_values(cosines)[nb - 1];

  VectorXd squares = VectorXd::Zero(joint_weights.size());
  double samples = 0;
  source([&](const InstrumentBlock& block) {
    squares += residual(block.rows, estimate.beta).colwise().squaredNorm().transpose();
    samples += static_cast<double>(block.rows.tau.rows());
  });
  estimate.residual_rms = (squares / std::max(samples, 1.0)).cwiseSqrt();

  // (Z'W)^-1 (sum w^4 Z' Omega Z) (W'Z)^-1, Omega from the residual of this fit
  const RowSource z_rows = [source, beta = estimate.beta](const auto& visit) {
    source([&](const InstrumentBlock& block) {
      visit(RowBlock{block.Z, residual(block.rows, beta), block.rows.counted,
                     block.rows.continues_run});
    });
  };
  const NoiseFactor noise = noise_factor(z_rows, columns, VectorXd::Zero(nb));
  const MatrixXd noisy =
      noise_rows(noise, columns, parameters, joint_weights) * z_scale.asDiagonal();
  const MatrixXd middle = noisy.transpose() * noisy;
  const MatrixXd ZW = (rows.W.leftCols(nb) * z_scale.asDiagonal()).transpose() * W;
  const MatrixXd inverse = pseudo_inverse(ZW);
  estimate.covariance =
      scale.asDiagonal() * inverse * middle * inverse.transpose() * scale.asDiagonal();
  test_exogeneity(source, columns, ZW, W, rows.tau, z_scale, result);
  return result;
}

}  // namespace dyngen::runtime
