// SPDX-License-Identifier: MIT
#include "runtime/estimation/errors_in_variables.h"

#include <algorithm>
#include <cmath>

#include "runtime/estimation/decompositions.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd errors_in_variables(const TorqueFactor& factor, const Estimate& estimate,
                             const TorqueFactor& noise) {
  const Index nb = factor.parameters;
  MatrixXd covariance = MatrixXd::Zero(nb, nb);
  const double equations = factor.samples();
  if (noise.joints.empty() || equations <= 0) return covariance;
  const MatrixXd basis =
      estimate.unseen.cols() == 0 ? MatrixXd::Identity(nb, nb) : complement_of(estimate.unseen);
  if (basis.cols() == 0) return covariance;
  const MatrixXd directions = estimate.scale.asDiagonal() * basis;
  const StackedRows rows = stacked(factor, estimate.joint_weights);
  const SingularValues G = decomposed(rows.W * directions);
  if (!(G.values[G.values.size() - 1] > 0)) return covariance;
  // columns v: of unit norm in G, any turn of them is as well
  const MatrixXd whitened = G.V * G.values.cwiseInverse().asDiagonal();
  const SingularValues C =
      decomposed(stacked(noise, estimate.joint_weights).W * directions * whitened);
  const MatrixXd v = directions * whitened * C.V;
  const VectorXd components = C.V.transpose() * (G.U.transpose() * (rows.W * estimate.beta));
  const double upper = 1 + 2 * std::sqrt(2 / equations);  // two deviations of chi-square over N
  const double torque = rows.tau.norm();
  for (Index k = 0; k < C.values.size(); ++k) {
    const double kappa = upper * C.values[k] * C.values[k];
    // a component is known to one deviation, which is 1 in these units
    const double component = std::hypot(components[k], 1);
    const double bias =
        kappa < 1 ? std::min(kappa / (1 - kappa) * component, torque) : torque;
    covariance += bias * bias * v.col(k) * v.col(k).transpose();
  }
  return covariance;
}

}  // namespace dyngen::runtime
