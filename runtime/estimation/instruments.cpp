// SPDX-License-Identifier: MIT
#include "runtime/estimation/instruments.h"

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

/// Coefficients of the regressor on the instruments, joint by joint: (n_j x n_j) each.
std::vector<MatrixXd> first_stage(const TorqueFactor& pairs) {
  std::vector<MatrixXd> stages;
  for (const JointFactor& joint : pairs.joints) {
    const Index half = (joint.R.cols() - 1) / 2;
    stages.push_back(
        least_norm_solution(joint.R.topLeftCorner(half, half), joint.R.block(0, half, half, half)));
  }
  return stages;
}

/// Rows of [W, what instruments leave of W].
RowSource augmented_rows(const InstrumentSource& source,
                         const std::vector<std::vector<int>>& columns, int parameters,
                         const std::vector<MatrixXd>& stages) {
  return [=](const std::function<void(const RowBlock&)>& visit) {
    source([&](const InstrumentBlock& block) {
      MatrixXd left = block.rows.Y;
      for (std::size_t j = 0; j < columns.size(); ++j) {
        const Index start = static_cast<Index>(j) * parameters;
        const MatrixXd Z = block.Z.middleCols(start, parameters)(Eigen::all, columns[j]);
        const MatrixXd explained = Z * stages[j];
        for (std::size_t i = 0; i < columns[j].size(); ++i) {
          left.col(start + columns[j][i]) -= explained.col(static_cast<Index>(i));
        }
      }
      visit({side_by_side(block.rows.Y, left, parameters), block.rows.tau, block.rows.counted,
             block.rows.continues_run});
    });
  };
}

void test_exogeneity(const InstrumentSource& source, const std::vector<std::vector<int>>& columns,
                     int parameters, const VectorXd& joint_weights, const TorqueFactor& pairs,
                     InstrumentalEstimate& result) {
  constexpr double kSame = 1e-6;  // instruments that equal the regressor leave rounding alone
  const std::vector<std::vector<int>> both = doubled(columns, parameters);
  const RowSource rows = augmented_rows(source, columns, parameters, first_stage(pairs));
  const TorqueFactor factor = factor_of(rows, both, 2 * parameters);
  LeastSquaresOptions options;
  options.decomposition = Decomposition::kSvd;
  // the scale of the regressor for what is left of it: a column that is all but gone stays small
  const VectorXd norms = column_norms(factor, joint_weights).head(parameters);
  options.scale.resize(2 * parameters);
  for (Index i = 0; i < parameters; ++i) {
    options.scale[i] = options.scale[i + parameters] = norms[i] > 0 ? 1 / norms[i] : 1;
  }
  options.tolerance = kSame;
  const Estimate fit = least_squares(factor, joint_weights, options);
  NoiseFactor noise = noise_factor(rows, both, fit.beta);
  give_back_fitted_noise(noise, factor, joint_weights, fit.scale, fit.unseen);
  const MatrixXd covariance =
      correlated_covariance(factor, noise, joint_weights, fit.scale, fit.unseen);
  const VectorXd scale = fit.scale.tail(parameters);
  const VectorXd gamma = fit.beta.tail(parameters).cwiseQuotient(scale);
  const MatrixXd spread = scale.cwiseInverse().asDiagonal() *
                          covariance.bottomRightCorner(parameters, parameters) *
                          scale.cwiseInverse().asDiagonal();
  const SingularValues svd = decomposed(spread);
  const VectorXd& variances = svd.values;
  const VectorXd along = svd.U.transpose() * gamma;
  for (Index i = 0; i < parameters; ++i) {
    if (variances[i] <= 1e-12 * variances[0]) break;
    result.hausman += along[i] * along[i] / variances[i];
    ++result.degrees;
  }
  if (result.degrees > 0) result.p_value = chi_square_tail(result.hausman, result.degrees);
}

}  // namespace

InstrumentalEstimate instrumental_variables(const InstrumentSource& source,
                                            const std::vector<std::vector<int>>& columns,
                                            int parameters, const VectorXd& joint_weights) {
  const TorqueFactor pairs =
      factor_of(paired_rows(source, parameters), doubled(columns, parameters), 2 * parameters);
  const StackedRows rows = stacked(pairs, joint_weights);
  const Index nb = parameters;
  VectorXd z_scale = rows.W.leftCols(nb).colwise().norm(),
           scale = rows.W.rightCols(nb).colwise().norm();
  for (Index i = 0; i < nb; ++i) {
    z_scale[i] = z_scale[i] > 0 ? 1 / z_scale[i] : 1;
    scale[i] = scale[i] > 0 ? 1 / scale[i] : 1;
  }
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
  test_exogeneity(source, columns, parameters, joint_weights, pairs, result);
  return result;
}

}  // namespace dyngen::runtime
