// SPDX-License-Identifier: MIT
#include "tests/blind/real/real_robot.h"

#include <Eigen/Geometry>
#include <array>
#include <numbers>
#include <stdexcept>

#include "tests/support/numeric_dynamics.h"

namespace blind {
namespace {

using dyngen::test::NumericJoint;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kHalfTurn = std::numbers::pi;

NumericJoint joint(int parent, double alpha, double d, double theta, double r) {
  NumericJoint made;
  made.parent = parent;
  made.alpha = alpha;
  made.d = d;
  made.theta = theta;
  made.r = r;
  return made;
}

std::vector<double> row(const MatrixXd& m, Index k) {
  std::vector<double> values(static_cast<std::size_t>(m.cols()));
  for (Index j = 0; j < m.cols(); ++j) values[static_cast<std::size_t>(j)] = m(k, j);
  return values;
}

}  // namespace

RealRobot real_robot(const std::string& name) {
  RealRobot robot;
  robot.name = name;
  if (name == "tx40") {
    robot.robot_file = "robots/tx40.robot";
    robot.train = {"tx40/tx40.csv"};
    robot.bodies.joints = {
        joint(0, 0, 0, 0, 0.32),           joint(1, -kHalfTurn / 2, 0, 0, 0),
        joint(2, 0, 0.225, 0, 0.035),      joint(3, kHalfTurn / 2, 0, 0, 0.225),
        joint(4, -kHalfTurn / 2, 0, 0, 0), joint(5, kHalfTurn / 2, 0, kHalfTurn, 0)};
    robot.bodies.base_acceleration = {0, 0, 9.81};
    robot.reach = 0.03;
    return robot;
  }
  if (name == "dfki") {
    robot.robot_file = "tests/blind/real/dfki_a.robot";
    robot.train = {"dfki/a_0.csv", "dfki/a_1.csv", "dfki/a_2.csv"};
    robot.held = {"dfki/a_3.csv"};
    robot.bodies.joints = {joint(0, 0, 0, 0, 0), joint(1, 0, 0.3, 0, 0)};
    robot.bodies.base_acceleration = {-9.81, 0, 0};
    robot.reach = 0.04;
    return robot;
  }
  throw std::invalid_argument("real_robot(): found '" + name + "', expected tx40 or dfki");
}

MatrixXd rigid_columns(const RealRobot& robot, const RealMotion& motion) {
  constexpr Index kOfLink = 10;
  const Index n = motion.samples(), joints = motion.joints();
  MatrixXd columns(n * joints, kOfLink * joints);
  dyngen::test::NumericRobot unit = robot.bodies;
  for (Index link = 0; link < joints; ++link) {
    auto& inertial = unit.joints[static_cast<std::size_t>(link)].inertial;
    for (Index p = 0; p < kOfLink; ++p) {
      inertial.fill(0);
      inertial[static_cast<std::size_t>(p)] = 1;
      for (Index k = 0; k < n; ++k) {
        const std::vector<double> torque =
            dyngen::test::id_rigid(unit, row(motion.q, k), row(motion.dq, k), row(motion.ddq, k));
        for (Index j = 0; j < joints; ++j) {
          columns(j * n + k, link * kOfLink + p) = torque[static_cast<std::size_t>(j)];
        }
      }
    }
    inertial.fill(0);
  }
  return columns;
}

VectorXd torque_of_force(const RealRobot& robot, const VectorXd& q, Index link,
                         const Vector3d& point, const Vector3d& force) {
  const auto frames = dyngen::test::forward_kinematics(
      robot.bodies, std::vector<double>(q.data(), q.data() + q.size()));
  const auto& own = frames[static_cast<std::size_t>(link)];
  const Vector3d at = own.topLeftCorner<3, 3>() * point + own.topRightCorner<3, 1>();
  VectorXd torque = VectorXd::Zero(q.size());
  for (Index j = 0; j <= link; ++j) {
    const auto& frame = frames[static_cast<std::size_t>(j)];
    const Vector3d axis = frame.col(2).head<3>(), origin = frame.col(3).head<3>();
    torque[j] = axis.dot((at - origin).cross(force));
  }
  return torque;
}

}  // namespace blind
