// SPDX-License-Identifier: MIT
#include "tests/peers/dart_arm.h"

#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/Inertia.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <string>
#include <utility>

#include "tests/peers/link_frames.h"

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

}  // namespace

DartArm::DartArm(const NumericRobot& robot) : skeleton(dd::Skeleton::create("robot")) {
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

}  // namespace dyngen::test
