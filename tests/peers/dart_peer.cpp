// SPDX-License-Identifier: MIT
// DART: skeletons of bodies; articulated-body and composite inertias by itself. Its headers are
// slow to compile and stand here and in dart_arm.cpp only.
#include <dart/dynamics/BodyNode.hpp>
#include <memory>

#include "tests/peers/dart_arm.h"
#include "tests/peers/peer.h"

namespace dyngen::test {
namespace {

namespace dd = dart::dynamics;

Eigen::VectorXd vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

std::vector<double> list(const Eigen::MatrixXd& matrix) {
  std::vector<double> result;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) result.push_back(matrix(i, k));
  }
  return result;
}

struct Dart : DartArm {
  using DartArm::DartArm;

  void set(const PeerInput& in) const {
    skeleton->setPositions(vector(in.q));
    if (!in.dq.empty()) skeleton->setVelocities(vector(in.dq));
    skeleton->clearExternalForces();
    const std::array<double, 6>& w = in.wrench;
    bodies.back()->addExtForce(Eigen::Vector3d(w[0], w[1], w[2]), Eigen::Vector3d::Zero(), true,
                               true);
    bodies.back()->addExtTorque(Eigen::Vector3d(w[3], w[4], w[5]), true);
  }
  [[nodiscard]] dd::BodyNode* body(int link) const {
    return link == 0 ? bodies.back() : bodies[static_cast<std::size_t>(link - 1)];
  }
};

}  // namespace

Peer make_dart_peer(const NumericRobot& robot) {
  const auto dart = std::make_shared<Dart>(robot);
  Peer peer;
  peer.name = "DART";
  peer.calls["id"] = [dart](const PeerInput& in) {
    dart->set(in);
    dart->skeleton->setAccelerations(vector(in.ddq));
    dart->skeleton->computeInverseDynamics(true);
    return list(dart->skeleton->getForces());
  };
  peer.calls["gravity"] = [dart](const PeerInput& in) {
    dart->set(in);
    return list(dart->skeleton->getGravityForces());
  };
  peer.calls["coriolis"] = [dart](const PeerInput& in) {
    dart->set(in);
    return list(dart->skeleton->getCoriolisForces());
  };
  peer.calls["mass_matrix"] = [dart](const PeerInput& in) {
    dart->set(in);
    return list(dart->skeleton->getMassMatrix());
  };
  peer.calls["fd"] = [dart](const PeerInput& in) {
    dart->set(in);
    dart->skeleton->setForces(vector(in.tau));
    dart->skeleton->computeForwardDynamics();
    return list(dart->skeleton->getAccelerations());
  };
  peer.calls["fk"] = [dart](const PeerInput& in) {
    dart->set(in);
    return list(dart->body(in.link)->getWorldTransform().matrix());
  };
  peer.calls["jacobian"] = [dart](const PeerInput& in) {
    dart->set(in);
    const Eigen::MatrixXd J = dart->skeleton->getWorldJacobian(dart->body(in.link));
    Eigen::MatrixXd linear_first(6, J.cols());
    linear_first << J.bottomRows(3), J.topRows(3);
    return list(linear_first);
  };
  return peer;
}

}  // namespace dyngen::test
