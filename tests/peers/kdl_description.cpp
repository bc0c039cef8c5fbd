// SPDX-License-Identifier: MIT
#include <kdl/treeidsolver_recursive_newton_euler.hpp>
#include <kdl_parser/kdl_parser.hpp>
#include <stdexcept>

#include "tests/peers/description_robots.h"

namespace dyngen::test {
namespace {

class KdlRobot : public TorqueRobot {
 public:
  KdlRobot(const std::string& urdf, ByJoint damping) : damping_(std::move(damping)) {
    KDL::Tree tree;
    if (!kdl_parser::treeFromString(urdf, tree)) throw std::runtime_error("kdl_parser");
    tree_ = KDL::Tree(tree);  // numbered as the solver's copy is
  }

  [[nodiscard]] ByJoint torque(const ByJoint& q, const ByJoint& dq,
                               const ByJoint& ddq) const override {
    KDL::TreeIdSolver_RNE solver(tree_, KDL::Vector(0, 0, -9.81));
    KDL::JntArray tau(tree_.getNrOfJoints());
    if (solver.CartToJnt(array(q), array(dq), array(ddq), {}, tau) < 0) {
      throw std::runtime_error("KDL");
    }
    ByJoint result;
    for_moving_joints([&](const std::string& name, unsigned place) {
      result[name] = tau(place);
      if (damping_.contains(name)) result[name] += damping_.at(name) * dq.at(name);
    });
    return result;
  }

 private:
  template <class Function>
  void for_moving_joints(const Function& function) const {
    for (const auto& [name, element] : tree_.getSegments()) {
      const KDL::Joint& joint = element.segment.getJoint();
      if (joint.getType() != KDL::Joint::None) function(joint.getName(), element.q_nr);
    }
  }
  [[nodiscard]] KDL::JntArray array(const ByJoint& values) const {
    KDL::JntArray result(tree_.getNrOfJoints());
    for_moving_joints(
        [&](const std::string& name, unsigned place) { result(place) = values.at(name); });
    return result;
  }

  ByJoint damping_;
  KDL::Tree tree_;
};

}  // namespace

std::unique_ptr<TorqueRobot> kdl_robot(const std::string& urdf, const ByJoint& damping) {
  return std::make_unique<KdlRobot>(urdf, damping);
}

}  // namespace dyngen::test
