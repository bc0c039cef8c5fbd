// SPDX-License-Identifier: MIT
#include "runtime/simulation/stiction.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace dyngen::runtime {
using Eigen::Index;
using Eigen::VectorXd;

VectorXd accelerations(const Eigen::MatrixXd& M, const VectorXd& push,
                       const std::vector<Index>& moving) {
  VectorXd ddq = VectorXd::Zero(push.size());
  if (moving.empty()) return ddq;
  const Eigen::LLT<Eigen::MatrixXd> factor(M(moving, moving));
  if (factor.info() != Eigen::Success) {
    throw std::runtime_error(
        "the mass matrix is not positive definite: expected masses and inertias of bodies that can "
        "exist");
  }
  const VectorXd part = push(moving);
  const VectorXd solved = factor.solve(part);
  ddq(moving) = solved;
  return ddq;
}

RestingJoints resting_joints(const Eigen::MatrixXd& M, const Eigen::VectorXd& torque,
                             const Eigen::VectorXd& coulomb,
                             const Eigen::Array<bool, Eigen::Dynamic, 1>& at_rest) {
  const Index n = torque.size();
  RestingJoints result;
  result.direction = Eigen::VectorXi::Zero(n);
  constexpr int kMostRounds = 100000;  // least-index pivoting ends; a bug or a NaN does not
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<Index> moving;
    for (Index j = 0; j < n; ++j) {
      if (!at_rest[j] || result.direction[j] != 0) moving.push_back(j);
    }
    const VectorXd push =
        torque - (coulomb.array() * result.direction.cast<double>().array()).matrix();
    result.ddq = accelerations(M, push, moving);
    result.held = torque - M * result.ddq;
    Index wrong = -1;
    for (Index j = 0; j < n && wrong < 0; ++j) {
      if (!at_rest[j]) continue;
      const bool slides = result.direction[j] != 0;
      if (slides ? result.ddq[j] * result.direction[j] < 0
                 : std::abs(result.held[j]) > coulomb[j] * (1 + kStictionMargin)) {
        wrong = j;
      }
    }
    if (wrong < 0) {
      for (Index j = 0; j < n; ++j) {
        if (!at_rest[j]) result.held[j] = 0;
      }
      return result;
    }
    result.direction[wrong] = result.direction[wrong] != 0 ? 0 : (result.held[wrong] > 0 ? 1 : -1);
  }
  throw std::runtime_error("no state of rest was found: expected finite torques");
}

}  // namespace dyngen::runtime
