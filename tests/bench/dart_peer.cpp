// SPDX-License-Identifier: MIT
// DART: its headers are slow to compile and stand here and in tests/peers only.
#include <algorithm>
#include <memory>
#include <vector>

#include "tests/bench/peers.h"
#include "tests/peers/dart_arm.h"

namespace dyngen::bench {
namespace {

std::vector<Eigen::VectorXd> vectors(const std::vector<double>& values, std::size_t joints) {
  std::vector<Eigen::VectorXd> result;
  for (std::size_t k = 0; k < kStates; ++k) {
    result.emplace_back(
        Eigen::Map<const Eigen::VectorXd>(&values[k * joints], static_cast<Eigen::Index>(joints)));
  }
  return result;
}

void copy(const Eigen::VectorXd& from, double* to) { std::copy_n(from.data(), from.size(), to); }

struct Dart : test::DartArm {
  Dart(const test::NumericRobot& robot, const States& states)
      : DartArm(robot),
        q(vectors(states.q, states.joints)),
        dq(vectors(states.dq, states.joints)),
        ddq(vectors(states.ddq, states.joints)),
        tau(vectors(states.tau, states.joints)) {}

  std::vector<Eigen::VectorXd> q, dq, ddq, tau;
};

}  // namespace

Peer make_dart_peer(const test::NumericRobot& robot, const States& states) {
  const auto dart = std::make_shared<Dart>(robot, states);
  Peer peer;
  peer["id"] = [dart](std::size_t k, double* tau) {
    dart->skeleton->setPositions(dart->q[k]);
    dart->skeleton->setVelocities(dart->dq[k]);
    dart->skeleton->setAccelerations(dart->ddq[k]);
    dart->skeleton->computeInverseDynamics();
    copy(dart->skeleton->getForces(), tau);
  };
  peer["gravity"] = [dart](std::size_t k, double* tau) {
    dart->skeleton->setPositions(dart->q[k]);
    copy(dart->skeleton->getGravityForces(), tau);
  };
  peer["mass_matrix"] = [dart](std::size_t k, double* M) {
    dart->skeleton->setPositions(dart->q[k]);
    const Eigen::MatrixXd& symmetric = dart->skeleton->getMassMatrix();
    std::copy_n(symmetric.data(), symmetric.size(), M);
  };
  peer["fd"] = [dart](std::size_t k, double* ddq) {
    dart->skeleton->setPositions(dart->q[k]);
    dart->skeleton->setVelocities(dart->dq[k]);
    dart->skeleton->setForces(dart->tau[k]);
    dart->skeleton->computeForwardDynamics();
    copy(dart->skeleton->getAccelerations(), ddq);
  };
  return peer;
}

}  // namespace dyngen::bench
