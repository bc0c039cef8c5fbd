// SPDX-License-Identifier: MIT
#include "tests/support/numeric_plant.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

#include "tests/support/numeric_dynamics.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::vector<double> list(const double* values, std::size_t n) { return {values, values + n}; }
std::vector<double> list(const VectorXd& v) { return {v.data(), v.data() + v.size()}; }

}  // namespace

runtime::PlantModel numeric_plant(const NumericRobot& robot) {
  const std::size_t n = robot.size();
  const runtime::ControlModel control = numeric_control(robot);
  runtime::PlantModel plant;
  plant.joints = control.joints;
  plant.rigid = control.rigid;
  plant.friction = control.friction;
  plant.mass_matrix = [robot, n](const double* q, double* M) {
    const SquareMatrix<double> matrix = mass_matrix(robot, list(q, n));
    std::copy_n(matrix.data(), n * n, M);  // symmetric: the order does not matter
  };
  plant.forward = [robot, n](const double* q, const double* dq, const double* tau, double* ddq) {
    const auto size = static_cast<Index>(n);
    const std::vector<double> loss =
        id(robot, list(q, n), list(dq, n), std::vector<double>(n, 0.0));
    const VectorXd left =
        Eigen::Map<const VectorXd>(tau, size) - Eigen::Map<const VectorXd>(loss.data(), size);
    Eigen::Map<VectorXd>(ddq, size) = mass_matrix(robot, list(q, n)).llt().solve(left);
  };
  plant.coulomb.resize(static_cast<Index>(n));
  for (std::size_t j = 0; j < n; ++j) plant.coulomb[static_cast<Index>(j)] = robot.joints[j].Fs;
  return plant;
}

runtime::ControlModel numeric_control(const NumericRobot& robot) {
  const std::size_t n = robot.size();
  runtime::ControlModel model;
  model.joints = static_cast<int>(n);
  model.rigid = [robot, n](const double* q, const double* dq, const double* ddq, double* tau) {
    const std::vector<double> torque = id_rigid(robot, list(q, n), list(dq, n), list(ddq, n));
    for (std::size_t j = 0; j < n; ++j) tau[j] = torque[j] + robot.joints[j].IA * ddq[j];
  };
  model.gravity = [robot, n](const double* q, double* tau) {
    const std::vector<double> torque = gravity(robot, list(q, n));
    std::copy(torque.begin(), torque.end(), tau);
  };
  model.friction = [robot, n](const double* dq, double* tau) {
    const std::vector<double> torque = friction(robot, list(dq, n));
    std::copy(torque.begin(), torque.end(), tau);
  };
  return model;
}

double energy(const NumericRobot& robot, const VectorXd& q, const VectorXd& dq) {
  double result = dq.dot(mass_matrix(robot, list(q)) * dq) / 2;
  const std::vector<Transform<double>> frames = forward_kinematics(robot, list(q));
  const Eigen::Map<const Eigen::Vector3d> up(robot.base_acceleration.data());
  for (std::size_t j = 0; j < robot.size(); ++j) {
    const auto& inertial = robot.joints[j].inertial;  // ... MX MY MZ M
    const Eigen::Vector3d moment(inertial[6], inertial[7], inertial[8]);
    const Eigen::Vector3d lifted =
        inertial[9] * frames[j].topRightCorner<3, 1>() + frames[j].topLeftCorner<3, 3>() * moment;
    result += up.dot(lifted);
  }
  return result;
}

NumericRobot without_friction(NumericRobot robot) {
  for (NumericJoint& joint : robot.joints) joint.Fs = joint.Fv = joint.off = 0;
  return robot;
}

}  // namespace dyngen::test
