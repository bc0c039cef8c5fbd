// SPDX-License-Identifier: MIT
#include "runtime/estimation/trust.h"

#include <cmath>
#include <limits>

#include "runtime/estimation/decompositions.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Trust measure_trust(const TorqueFactor& factor, const Estimate& estimate,
                    const TorqueFactor& regressor_noise, double sample_time) {
  Trust trust;
  const VectorXd& weights = estimate.joint_weights;
  const StackedRows rows = stacked(factor, weights);
  const MatrixXd H = rows.W * estimate.scale.asDiagonal();
  const VectorXd B = estimate.beta.cwiseQuotient(estimate.scale);
  const VectorXd singular = singular_values(H);
  const bool any = singular.size() > 0;
  const double largest = any ? singular[0] : 0, smallest = any ? singular[singular.size() - 1] : 0;
  const double residual = (rows.tau - H * B).norm();
  const double samples = std::max(factor.samples(), 1.0);
  const Index nb = H.cols();

  MatrixXd C = MatrixXd::Zero(nb, nb);  // sum of dH'dH
  if (!regressor_noise.joints.empty()) {
    const MatrixXd D = stacked(regressor_noise, weights).W * estimate.scale.asDiagonal();
    C = D.transpose() * D;
  }
  const double noise = any ? singular_values(C)[0] : 0;
  trust.regressor_noise = std::sqrt(noise);
  trust.torque_noise = residual;

  const double inverse = smallest > 0 ? 1 / smallest : std::numeric_limits<double>::infinity();
  const double left = 1 - trust.regressor_noise * inverse;
  trust.perturbation_bound = std::numeric_limits<double>::infinity();
  if (left > 0 && B.norm() > 0) {
    const double condition = largest * inverse;
    trust.perturbation_bound =
        condition * (trust.regressor_noise * (B.norm() + inverse * residual) + residual) /
        (largest * left) / B.norm();
  }

  const MatrixXd inverse_R = pseudo_inverse(H.transpose() * H);
  trust.attenuation = estimate.scale.cwiseProduct(inverse_R * (C * B));
  trust.worst_bias =
      estimate.scale.cwiseProduct(inverse_R.diagonal().cwiseMax(0.0).cwiseSqrt()) * residual;

  trust.time_constant = sample_time * std::pow(largest * inverse, 2);
  trust.smallest_singular_value = smallest * smallest / samples;
  trust.singular_value_change = noise / samples;
  trust.bias_susceptibility =
      B.norm() > 0 ? rows.tau.norm() * inverse / B.norm() : std::numeric_limits<double>::infinity();
  return trust;
}

}  // namespace dyngen::runtime
