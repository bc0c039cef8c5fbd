// SPDX-License-Identifier: MIT
#include <memory>

#include "tests/bench/peers.h"
#include "tests/peers/dart_skeleton.h"

namespace dyngen::bench {
namespace {

std::vector<Eigen::VectorXd> vectors(const std::vector<double>& values, std::size_t joints) {
  std::vector<Eigen::VectorXd> result;
  for (std::size_t k = 0; k < kStates; ++k) {
    result.emplace_back(Eigen::Map<const Eigen::VectorXd>(values.data() + k * joints,
                                                          static_cast<Eigen::Index>(joints)));
  }
  return result;
}

struct Dart {
  Dart(const test::NumericRobot& robot, const States& states)
      : skeleton(test::make_dart_skeleton(robot).skeleton),
        q(vectors(states.q, states.joints)),
        dq(vectors(states.dq, states.joints)),
        ddq(vectors(states.ddq, states.joints)),
        tau(vectors(states.tau, states.joints)) {}

  void copy(const Eigen::VectorXd& v, double* out) const {
    Eigen::Map<Eigen::VectorXd>(out, v.size()) = v;
  }

  dart::dynamics::SkeletonPtr skeleton;
  std::vector<Eigen::VectorXd> q, dq, ddq, tau;
};

}  // namespace

Peer make_dart_peer(const test::NumericRobot& robot, const States& states) {
  const auto dart = std::make_shared<Dart>(robot, states);
  Peer peer{.name = "DART", .calls = {}};
  peer.calls["id"] = [dart](std::size_t k, double* out) {
    dart->skeleton->setPositions(dart->q[k]);
    dart->skeleton->setVelocities(dart->dq[k]);
    dart->skeleton->setAccelerations(dart->ddq[k]);
    dart->skeleton->computeInverseDynamics();
    dart->copy(dart->skeleton->getForces(), out);
  };
  peer.calls["mass_matrix"] = [dart](std::size_t k, double* out) {
    dart->skeleton->setPositions(dart->q[k]);
    const Eigen::MatrixXd& M = dart->skeleton->getMassMatrix();
    Eigen::Map<Eigen::MatrixXd>(out, M.rows(), M.cols()) = M;
  };
  peer.calls["fd"] = [dart](std::size_t k, double* out) {
    dart->skeleton->setPositions(dart->q[k]);
    dart->skeleton->setVelocities(dart->dq[k]);
    dart->skeleton->setForces(dart->tau[k]);
    dart->skeleton->computeForwardDynamics();
    dart->copy(dart->skeleton->getAccelerations(), out);
  };
  return peer;
}

}  // namespace dyngen::bench
