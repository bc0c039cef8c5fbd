// SPDX-License-Identifier: MIT
#include "tests/runtime/excitation/small_arm.h"

#include <limits>

namespace dyngen::test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using runtime::JointMotion;

runtime::LinearModel small_arm() {
  runtime::LinearModel model;
  model.name = "small";
  model.joint_names = {"1", "2"};
  model.revolute = {true, true};
  for (const char* name : {"J", "G", "F", "C"}) {
    runtime::LinearParameter parameter;
    parameter.name = name;
    model.parameters.push_back(parameter);
  }
  model.columns = {{0, 1, 2}, {0, 3}};
  model.regressor = [](const MatrixXd& q, const MatrixXd& dq, const MatrixXd& ddq, MatrixXd& Y) {
    Y = MatrixXd::Zero(q.rows(), 8);
    const Eigen::ArrayXd c2 = q.col(1).array().cos(), s2 = q.col(1).array().sin();
    Y.col(0) = ddq.col(0).array() + c2 * ddq.col(1).array();
    Y.col(1) = q.col(0).array().cos();
    Y.col(2) = dq.col(0);
    Y.col(4) = c2 * ddq.col(0).array();
    Y.col(7) = s2 * dq.col(0).array().square();
  };
  model.regressor_gradient = [](const JointMotion& m, const MatrixXd& A) {
    const Eigen::ArrayXd c2 = m.q.col(1).array().cos(), s2 = m.q.col(1).array().sin();
    JointMotion g{m.q * 0, m.q * 0, m.q * 0};
    g.q.col(0) = -A.col(1).array() * m.q.col(0).array().sin();
    g.q.col(1) = -A.col(0).array() * s2 * m.ddq.col(1).array() -
                 A.col(4).array() * s2 * m.ddq.col(0).array() +
                 A.col(7).array() * c2 * m.dq.col(0).array().square();
    g.dq.col(0) = A.col(2).array() + 2 * A.col(7).array() * s2 * m.dq.col(0).array();
    g.ddq.col(0) = A.col(0).array() + A.col(4).array() * c2;
    g.ddq.col(1) = A.col(0).array() * c2;
    return g;
  };
  return model;
}

runtime::MotionLimits small_arm_limits() {
  runtime::MotionLimits limits;
  limits.lower = Eigen::Vector2d(-2, -1);
  limits.upper = Eigen::Vector2d(2, 1.5);
  limits.speed = Eigen::Vector2d(3, 2);
  limits.acceleration = Eigen::Vector2d(8, 10);
  limits.torque = VectorXd::Constant(2, std::numeric_limits<double>::infinity());
  return limits;
}

}  // namespace dyngen::test
