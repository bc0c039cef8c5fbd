// SPDX-License-Identifier: MIT
#include "runtime/estimation/covariance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "runtime/estimation/decompositions.h"
#include "runtime/estimation/distributions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rows of a joint's triangle over the seen directions, in scaled parameters: (rows x rank).
MatrixXd spread(const MatrixXd& triangle, const std::vector<int>& columns, const MatrixXd& basis,
                const VectorXd& scale) {
  MatrixXd rows = MatrixXd::Zero(triangle.rows(), basis.cols());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    rows += triangle.col(static_cast<Index>(i)) * scale[columns[i]] * basis.row(columns[i]);
  }
  return rows;
}

/// Orthonormal directions besides the unseen ones.
MatrixXd seen_directions(const MatrixXd& unseen, Index parameters) {
  return unseen.cols() == 0 ? MatrixXd::Identity(parameters, parameters) : complement_of(unseen);
}

/// What each joint adds to the matrices of the sandwich, over the seen directions.
struct Sandwich {
  std::vector<MatrixXd> outer;   ///< w^2 Y'Y
  std::vector<MatrixXd> middle;  ///< w^4 Y' Omega Y
  MatrixXd inverse;              ///< of the sum of outer
};

Sandwich sandwich(const TorqueFactor& factor, const std::vector<MatrixXd>& F,
                  const VectorXd& joint_weights, const VectorXd& scale, const MatrixXd& basis) {
  Sandwich parts;
  MatrixXd sum = MatrixXd::Zero(basis.cols(), basis.cols());
  for (std::size_t j = 0; j < factor.joints.size(); ++j) {
    const double w = joint_weights[static_cast<Index>(j)];
    const Index size = static_cast<Index>(factor.columns[j].size());
    const MatrixXd rows =
        w * spread(factor.joints[j].R.leftCols(size), factor.columns[j], basis, scale);
    const MatrixXd noisy = w * w * spread(F[j], factor.columns[j], basis, scale);
    parts.outer.push_back(rows.transpose() * rows);
    parts.middle.push_back(noisy.transpose() * noisy);
    sum += parts.outer.back();
  }
  parts.inverse = pseudo_inverse(sum);
  return parts;
}

MatrixXd sum(const std::vector<MatrixXd>& matrices) {
  MatrixXd all = matrices.front();
  for (std::size_t i = 1; i < matrices.size(); ++i) all += matrices[i];
  return all;
}

MatrixXd in_parameters(const MatrixXd& covariance, const MatrixXd& basis, const VectorXd& scale) {
  const MatrixXd L = scale.asDiagonal() * basis;
  return L * covariance * L.transpose();
}

}  // namespace

MatrixXd noise_rows(const NoiseFactor& noise, const std::vector<std::vector<int>>& columns,
                    int parameters, const VectorXd& joint_weights) {
  Index count = 0;
  for (const MatrixXd& F : noise.F) count += F.rows();
  MatrixXd rows = MatrixXd::Zero(count, parameters);
  Index start = 0;
  for (std::size_t j = 0; j < noise.F.size(); ++j) {
    const MatrixXd& F = noise.F[j];
    const double w = joint_weights[static_cast<Index>(j)];
    for (std::size_t i = 0; i < columns[j].size(); ++i) {
      rows.col(columns[j][i]).segment(start, F.rows()) = w * w * F.col(static_cast<Index>(i));
    }
    start += F.rows();
  }
  return rows;
}

void give_back_fitted_noise(NoiseFactor& noise, const TorqueFactor& factor,
                            const VectorXd& joint_weights, const VectorXd& scale,
                            const MatrixXd& unseen) {
  constexpr double kLeast = 0.05;  // of the noise is left: below that nothing is known about it
  const MatrixXd basis = seen_directions(unseen, factor.parameters);
  const Sandwich parts = sandwich(factor, noise.F, joint_weights, scale, basis);
  const MatrixXd covariance = parts.inverse * sum(parts.middle) * parts.inverse;
  for (Index j = 0; j < noise.power.size(); ++j) {
    const std::size_t k = static_cast<std::size_t>(j);
    // w^2 E|e_j|^2 = w^2 E|noise|^2 - taken
    const double total = noise.power[j] * joint_weights[j] * joint_weights[j];
    const double taken = 2 * parts.inverse.cwiseProduct(parts.middle[k]).sum() -
                         parts.outer[k].cwiseProduct(covariance).sum();
    const double left = total > 0 ? std::max(1 - taken / total, kLeast) : 1;
    noise.F[k] /= std::sqrt(left);
    noise.power[j] /= left;
    noise.correlated_power[j] /= left;
  }
}

MatrixXd correlated_covariance(const TorqueFactor& factor, const NoiseFactor& noise,
                               const VectorXd& joint_weights, const VectorXd& scale,
                               const MatrixXd& unseen) {
  const MatrixXd basis = seen_directions(unseen, factor.parameters);
  const Sandwich parts = sandwich(factor, noise.F, joint_weights, scale, basis);
  return in_parameters(parts.inverse * sum(parts.middle) * parts.inverse, basis, scale);
}

MatrixXd white_covariance(const TorqueFactor& factor, const VectorXd& beta,
                          const VectorXd& joint_weights, const VectorXd& scale,
                          const MatrixXd& unseen) {
  const MatrixXd basis = seen_directions(unseen, factor.parameters);
  const VectorXd deviation = residual_deviation(factor, beta);
  std::vector<MatrixXd> F;
  for (std::size_t j = 0; j < factor.joints.size(); ++j) {
    F.push_back(deviation[static_cast<Index>(j)] *
                factor.joints[j].R.leftCols(static_cast<Index>(factor.columns[j].size())));
  }
  const Sandwich parts = sandwich(factor, F, joint_weights, scale, basis);
  return in_parameters(parts.inverse * sum(parts.middle) * parts.inverse, basis, scale);
}

double interval_of(const TorqueFactor& factor, const NoiseFactor& noise) {
  const VectorXd times = noise.correlation_time();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < factor.joints.size(); ++j) {
    if (factor.joints[j].rows == 0) continue;
    const double worth = factor.joints[j].rows / std::max(1.0, times[static_cast<Index>(j)]);
    least = std::min(least, worth - static_cast<double>(factor.columns[j].size()));
  }
  if (!std::isfinite(least)) least = 0;  // no joint has equations
  return student_interval(0.95, std::max(2.0, least));
}

}  // namespace dyngen::runtime
