// SPDX-License-Identifier: MIT
// DART: skeletons of bodies; articulated-body and composite inertias by itself. Its headers are
// slow to compile and stand in this file only.
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/Inertia.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <memory>
#include <string>
#include <utility>

#include "tests/peers/link_frames.h"
#include "tests/peers/peer.h"

namespace dyngen::test {
namespace {

namespace dd = dart::dynamics;

/// A body on a joint; names of their own keep DART from announcing those that it invents.
template <typename Joint>
std::pair<Joint*, dd::BodyNode*> add(dd::Skeleton& skeleton, dd::BodyNode* parent,
                                     const std::string& name) {
  typename Joint::Properties joint;
  joint.mName = "joint" + name;
  return skeleton.createJointAndBodyNodePair<Joint>(parent, joint,
                                                    dd::BodyNode::AspectProperties("link" + name));
}

std::pair<dd::Joint*, dd::BodyNode*> add(dd::Skeleton& skeleton, dd::BodyNode* parent, int sigma,
                                         const std::string& name) {
  if (sigma == 0) {
    const auto [joint, body] = add<dd::RevoluteJoint>(skeleton, parent, name);
    joint->setAxis(Eigen::Vector3d::UnitZ());
    return {joint, body};
  }
  if (sigma == 1) {
    const auto [joint, body] = add<dd::PrismaticJoint>(skeleton, parent, name);
    joint->setAxis(Eigen::Vector3d::UnitZ());
    return {joint, body};
  }
  return add<dd::WeldJoint>(skeleton, parent, name);
}

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

struct Dart {
  explicit Dart(const NumericRobot& robot) : skeleton(dd::Skeleton::create("robot")) {
    const auto& a = robot.base_acceleration;
    skeleton->setGravity(-Eigen::Vector3d(a[0], a[1], a[2]));
    for (std::size_t j = 0; j < robot.size(); ++j) {
      const NumericJoint& numbers = robot.joints[j];
      dd::BodyNode* const parent =
          numbers.parent == 0 ? nullptr : bodies[static_cast<std::size_t>(numbers.parent - 1)];
      const auto [joint, body] = add(*skeleton, parent, numbers.sigma, std::to_string(j + 1));
      const LinkFrames frames = link_frames(robot, j);
      joint->setTransformFromParentBodyNode(frames.before);
      joint->setTransformFromChildBodyNode(frames.after.inverse());
      const CentralInertia link = central_inertia(numbers);
      body->setInertia(
          dd::Inertia(link.mass, Eigen::Vector3d(link.com.data()), central_tensor(link)));
      bodies.push_back(body);
    }
  }

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

  dd::SkeletonPtr skeleton;
  std::vector<dd::BodyNode*> bodies;
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
