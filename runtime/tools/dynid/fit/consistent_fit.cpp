// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/fit/consistent_fit.h"

#include <Eigen/QR>
#include <algorithm>

#include "runtime/consistency/consistent_parameters.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

ConsistentFit fit_consistently(const FitReport& report) {
  const TorqueFactor& equations = report.data.summary.equations;
  const DescribedRobot& robot = report.robot;
  // unit variance: each joint over its noise, and as many samples as correlated noise is worth
  const VectorXd times = report.data.summary.noise.correlation_time();
  const VectorXd weights =
      weighted_least_squares(equations).joint_weights.array() / times.array().max(1.0).sqrt();
  const StackedRows rows = stacked(equations, weights);
  const Index nb = equations.parameters;
  MatrixXd all(rows.W.rows(), nb + 1);
  all << rows.W, rows.tau;
  const MatrixXd R = all.householderQr().matrixQR().topRows(nb + 1);

  ConsistencyProblem problem;
  problem.links = robot.model.size();
  problem.K = robot.grouping;
  problem.R = R.topLeftCorner(nb, nb).triangularView<Eigen::Upper>();
  problem.z = R.topRightCorner(nb, 1);
  problem.prior = robot.standard;
  problem.free.assign(static_cast<std::size_t>(robot.standard.size()), true);
  for (int link = 1; link <= problem.links; ++link) {
    for (std::size_t k = kInertialCount; k < kChiCount; ++k) {
      const Quantity& quantity = robot.model.joint(link).chi[k];
      problem.free[static_cast<std::size_t>(link - 1) * kChiCount + k] = !quantity.known_zero();
    }
  }
  const ConsistentEstimate estimate = fit_consistent(problem);
  ConsistentFit fit;
  fit.standard = estimate.chi;
  fit.beta = estimate.beta;
  fit.pull = estimate.pull;
  fit.cost_free = estimate.cost_free;
  fit.cost = estimate.cost;
  fit.converged = estimate.converged;
  fit.message = estimate.message;
  fit.percent = residual_of(equations, fit.beta).percent;
  if (report.data.heldout) {
    fit.heldout_percent = residual_of(*report.data.heldout, fit.beta).percent;
  }
  return fit;
}

}  // namespace dyngen::runtime
