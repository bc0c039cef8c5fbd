// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/fit/consistent_fit.h"

#include <Eigen/QR>
#include <algorithm>
#include <limits>

#include "gen/symbols/exact.h"
#include "runtime/consistency/consistent_parameters.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Numbers of the file, a 0 that is written among them; NaN where it says nothing.
VectorXd written_values(const RobotFile& file) {
  const RobotModel model = build_model(file);
  VectorXd values(static_cast<Index>(kChiCount) * model.size());
  for (int j = 1; j <= model.size(); ++j) {
    for (std::size_t k = 0; k < kChiCount; ++k) {
      const Quantity& quantity = model.joint(j).chi[k];
      const bool said = quantity.line != 0 && !quantity.unknown;
      values[static_cast<Index>(kChiCount) * (j - 1) + static_cast<Index>(k)] =
          said ? to_double(quantity.value) : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return values;
}

}  // namespace

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
  problem.prior = written_values(robot.file);
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
