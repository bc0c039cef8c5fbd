// SPDX-License-Identifier: MIT
#include "tests/runtime/consistency/measured_robot.h"

#include <Eigen/QR>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/numeric_dynamics.h"
#include "tests/support/physical_robot.h"

namespace dyngen::test {
namespace {

/// The place of a parameter in chi: XX .. M IA FV FS OFF.
double& parameter(NumericJoint& joint, int kind) {
  switch (kind) {
    case 10:
      return joint.IA;
    case 11:
      return joint.Fv;
    case 12:
      return joint.Fs;
    case 13:
      return joint.off;
    default:
      return joint.inertial[static_cast<std::size_t>(kind)];
  }
}

/// (states links x 14 links)
Eigen::MatrixXd stacked_regressor(NumericRobot robot, unsigned seed, int states) {
  const int n = static_cast<int>(robot.size());
  for (NumericJoint& joint : robot.joints) {
    for (int kind = 0; kind < 14; ++kind) parameter(joint, kind) = 0;
  }
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-3, 3);
  Eigen::MatrixXd W(states * n, 14 * n);
  for (int state = 0; state < states; ++state) {
    std::vector<double> q(robot.size()), dq(robot.size()), ddq(robot.size());
    for (std::size_t j = 0; j < robot.size(); ++j) {
      q[j] = number(random);
      dq[j] = number(random);
      ddq[j] = 3 * number(random);
    }
    for (int column = 0; column < 14 * n; ++column) {
      double& one = parameter(robot.joints[static_cast<std::size_t>(column / 14)], column % 14);
      one = 1;
      const std::vector<double> tau = id(robot, q, dq, ddq);
      one = 0;
      W.col(column).segment(state * n, n) = Eigen::Map<const Eigen::VectorXd>(tau.data(), n);
    }
  }
  return W;
}

}  // namespace

MeasuredRobot measured_robot(unsigned seed, int links, double sigma) {
  NumericRobot robot = physical_robot(seed, links);
  robot.base_acceleration = {0, 0, 9.81};
  MeasuredRobot result;
  result.chi.resize(14 * links);
  for (int place = 0; place < 14 * links; ++place) {
    result.chi[place] = parameter(robot.joints[static_cast<std::size_t>(place / 14)], place % 14);
  }
  const Eigen::MatrixXd W = stacked_regressor(robot, seed, 40);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> pivoted(W);
  pivoted.setThreshold(1e-10);
  const Eigen::Index nb = pivoted.rank();
  // W P = Q [R1 R2; 0 0], so that W = (W P)_independent [1, R1^-1 R2] P'.
  const Eigen::MatrixXd P = pivoted.colsPermutation();
  const Eigen::MatrixXd upper =
      pivoted.matrixR().topRows(nb).triangularView<Eigen::Upper>().toDenseMatrix();
  const Eigen::MatrixXd R1 = upper.leftCols(nb);

  runtime::ConsistencyProblem& problem = result.problem;
  problem.links = links;
  problem.K = R1.triangularView<Eigen::Upper>().solve(upper) * P.transpose();
  problem.K = (problem.K.array().abs() < 1e-12).select(0, problem.K);
  problem.R = R1 / sigma;  // Q is orthonormal
  result.beta = problem.K * result.chi;
  problem.z = problem.R * result.beta;
  problem.prior = Eigen::VectorXd::Constant(14 * links, std::numeric_limits<double>::quiet_NaN());
  problem.free.assign(static_cast<std::size_t>(14 * links), true);
  return result;
}

void add_noise(runtime::ConsistencyProblem& problem, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  for (double& value : problem.z) value += normal(random);
}

}  // namespace dyngen::test
