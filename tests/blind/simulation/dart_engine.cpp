// SPDX-License-Identifier: MIT
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/Inertia.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <memory>
#include <string>
#include <utility>

#include "tests/blind/simulation/engine.h"

namespace blind {
namespace {

namespace dd = dart::dynamics;
using Eigen::VectorXd;

template <typename Joint>
dd::BodyNode* add(dd::Skeleton& skeleton, dd::BodyNode* parent, const Link& link) {
  typename Joint::Properties properties;
  properties.mName = "joint_" + link.name;
  const auto [joint, body] = skeleton.createJointAndBodyNodePair<Joint>(
      parent, properties, dd::BodyNode::AspectProperties("link_" + link.name));
  joint->setAxis(link.axis);
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.translation() = link.position;
  place.linear() = link.turn.toRotationMatrix();
  joint->setTransformFromParentBodyNode(place);
  return body;
}

struct DartWorld {
  dd::SkeletonPtr skeleton = dd::Skeleton::create("tree");
  std::vector<dd::BodyNode*> bodies;

  void set_inertia(std::size_t link, const Inertia& inertia) const {
    // DART refuses a body without mass
    const double mass = std::max(inertia.mass, 1e-9);
    bodies[link]->setInertia(
        dd::Inertia(mass, inertia.com, inertia.about_com + 1e-12 * Eigen::Matrix3d::Identity()));
  }
  void move(const VectorXd& q, const VectorXd& dq) const {
    skeleton->setPositions(q);
    skeleton->setVelocities(dq);
  }
};

}  // namespace

Engine dart_engine(const Tree& tree) {
  const auto world = std::make_shared<DartWorld>();
  world->skeleton->setGravity(tree.gravity);
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const Link& link = tree.links[i];
    dd::BodyNode* const parent =
        link.parent < 0 ? nullptr : world->bodies[static_cast<std::size_t>(link.parent)];
    world->bodies.push_back(link.slides ? add<dd::PrismaticJoint>(*world->skeleton, parent, link)
                                        : add<dd::RevoluteJoint>(*world->skeleton, parent, link));
    world->set_inertia(i, link.inertia);
  }
  Engine engine;
  engine.name = "DART";
  engine.dynamics = [world](const VectorXd& q, const VectorXd& dq, Dynamics& result) {
    world->move(q, dq);
    result.M = world->skeleton->getMassMatrix();
    result.bias = world->skeleton->getCoriolisAndGravityForces();
  };
  engine.inverse = [world](const VectorXd& q, const VectorXd& dq, const VectorXd& ddq) -> VectorXd {
    world->move(q, dq);
    world->skeleton->setAccelerations(ddq);
    world->skeleton->computeInverseDynamics();
    return world->skeleton->getForces();
  };
  engine.jacobian = [world](const VectorXd& q, int link,
                            const Eigen::Vector3d& point) -> Eigen::MatrixXd {
    world->skeleton->setPositions(q);
    const dd::BodyNode* const body = world->bodies[static_cast<std::size_t>(link)];
    const dart::math::LinearJacobian local = body->getLinearJacobian(point);
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3, q.size());
    for (std::size_t i = 0; i < body->getNumDependentGenCoords(); ++i) {
      all.col(static_cast<Eigen::Index>(body->getDependentGenCoordIndex(i))) =
          local.col(static_cast<Eigen::Index>(i));
    }
    return all;
  };
  engine.place = [world](const VectorXd& q, int link, const Eigen::Vector3d& point) {
    world->skeleton->setPositions(q);
    return Eigen::Vector3d(world->bodies[static_cast<std::size_t>(link)]->getTransform() * point);
  };
  engine.set_inertia = [world](int link, const Inertia& inertia) {
    world->set_inertia(static_cast<std::size_t>(link), inertia);
  };
  return engine;
}

}  // namespace blind
