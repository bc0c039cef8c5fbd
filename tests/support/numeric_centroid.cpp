// SPDX-License-Identifier: MIT
#include "tests/support/numeric_centroid.h"

#include <Eigen/Geometry>
#include <numeric>

#include "tests/support/numeric_derivatives.h"
#include "tests/support/numeric_dynamics.h"

namespace dyngen::test {
namespace {

using Vector3L = Eigen::Matrix<long double, 3, 1>;
using Matrix3L = Eigen::Matrix<long double, 3, 3>;

constexpr long double kMassStep = 1e-4L, kPoseStep = 1e-4L;

/// d f / d x at 0, f of any vector type: (8 (f(h) - f(-h)) - (f(2h) - f(-2h))) / 12 h.
template <typename Function>
auto slope(const Function& f, long double h) {
  using Value = decltype(f(h));
  return Value((8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h));
}

std::vector<std::size_t> moving(const RobotModel& model) {
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (model.joints[j].coordinate >= 0) joints.push_back(j);
  }
  return joints;
}

std::vector<long double> moved(std::vector<long double> q,
                               const std::vector<long double>& direction, long double step) {
  for (std::size_t j = 0; j < q.size(); ++j) q[j] += step * direction[j];
  return q;
}

/// First moment of all links about the origin of frame 0.
Vector3L first_moment(const NumericRobot& robot, const std::vector<long double>& q) {
  const std::vector<Transform<long double>> frames = forward_kinematics(robot, q);
  Vector3L sum = Vector3L::Zero();
  for (std::size_t j = 0; j < robot.size(); ++j) {
    const auto& body = robot.joints[j].inertial;
    const Matrix3L R = frames[j].topLeftCorner<3, 3>();
    const Vector3L origin = frames[j].topRightCorner<3, 1>();
    sum += R * Vector3L(body[6], body[7], body[8]) + body[9] * origin;
  }
  return sum;
}

}  // namespace

std::vector<long double> mass_matrix_rate(const RobotModel& model, const NumericRobot& robot,
                                          const MotionSample& sample) {
  const std::vector<long double> q = joint_values(model, sample.q),
                                 dq = joint_values(model, sample.dq);
  const SquareMatrix<long double> rate =
      slope([&](long double h) { return mass_matrix(robot, moved(q, dq, h)); }, kMassStep);
  std::vector<long double> result;
  for (const std::size_t i : moving(model)) {
    for (const std::size_t j : moving(model)) {
      result.push_back(rate(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
  }
  return result;
}

std::vector<long double> christoffel_matrix(const RobotModel& model, const NumericRobot& robot,
                                            const MotionSample& sample) {
  const std::vector<long double> q = joint_values(model, sample.q),
                                 dq = joint_values(model, sample.dq);
  const std::vector<std::size_t> joints = moving(model);
  std::vector<SquareMatrix<long double>> by_joint(robot.size());
  for (const std::size_t k : joints) {
    std::vector<long double> unit(robot.size(), 0.0L);
    unit[k] = 1;
    by_joint[k] =
        slope([&](long double h) { return mass_matrix(robot, moved(q, unit, h)); }, kMassStep);
  }
  const auto element = [&](std::size_t i, std::size_t j, std::size_t k) {
    return by_joint[k](static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  };
  std::vector<long double> C;
  for (const std::size_t i : joints) {
    for (const std::size_t j : joints) {
      long double sum = 0;
      for (const std::size_t k : joints) {
        sum += (element(i, j, k) + element(i, k, j) - element(j, k, i)) / 2 * dq[k];
      }
      C.push_back(sum);
    }
  }
  return C;
}

std::vector<long double> torque_of_wrench(const RobotModel& model, const NumericRobot& robot,
                                          const std::vector<double>& q, std::size_t link,
                                          const std::vector<long double>& wrench) {
  std::vector<long double> torque;
  const std::vector<long double> values = joint_values(model, q);
  for (const std::size_t joint : moving(model)) {
    const std::array<long double, 6> screw = joint_screw(robot, values, joint, link);
    torque.push_back(std::inner_product(screw.begin(), screw.end(), wrench.begin(), 0.0L));
  }
  return torque;
}

NumericCentroid numeric_centroid(const RobotModel& model, const NumericRobot& robot,
                                 const MotionSample& sample) {
  const std::vector<long double> q = joint_values(model, sample.q),
                                 dq = joint_values(model, sample.dq);
  NumericCentroid result;
  for (const NumericJoint& joint : robot.joints) result.mass += joint.inertial[9];
  const Vector3L center = first_moment(robot, q) / result.mass;
  for (int k = 0; k < 3; ++k) result.center[static_cast<std::size_t>(k)] = center[k];

  const std::vector<std::size_t> joints = moving(model);
  result.jacobian.assign(3 * joints.size(), 0.0L);
  for (std::size_t column = 0; column < joints.size(); ++column) {
    std::vector<long double> unit(robot.size(), 0.0L);
    unit[joints[column]] = 1;
    const Vector3L velocity =
        slope([&](long double h) { return first_moment(robot, moved(q, unit, h)); }, kPoseStep) /
        result.mass;
    for (std::size_t k = 0; k < 3; ++k) {
      result.jacobian[k * joints.size() + column] = velocity[static_cast<Eigen::Index>(k)];
    }
  }

  const std::vector<Transform<long double>> frames = forward_kinematics(robot, q);
  Vector3L linear = Vector3L::Zero(), angular = Vector3L::Zero();
  for (std::size_t j = 0; j < robot.size(); ++j) {
    const auto& b = robot.joints[j].inertial;
    const Transform<long double> rate = slope(
        [&](long double h) { return forward_kinematics(robot, moved(q, dq, h))[j]; }, kPoseStep);
    const Matrix3L R = frames[j].topLeftCorner<3, 3>();
    const Matrix3L spin = rate.topLeftCorner<3, 3>() * R.transpose();
    const Vector3L w(spin(2, 1), spin(0, 2), spin(1, 0));
    const Vector3L v = rate.topRightCorner<3, 1>(), origin = frames[j].topRightCorner<3, 1>();
    const Vector3L h = R * Vector3L(b[6], b[7], b[8]);
    Matrix3L J;
    J << b[0], b[1], b[2], b[1], b[3], b[4], b[2], b[4], b[5];
    const Vector3L p = b[9] * v + w.cross(h);
    linear += p;
    angular += origin.cross(p) + R * (J * (R.transpose() * w)) + h.cross(v);
  }
  for (int k = 0; k < 3; ++k) {
    result.momentum[static_cast<std::size_t>(k)] = linear[k];
    result.momentum[static_cast<std::size_t>(k + 3)] = angular[k];
  }
  return result;
}

}  // namespace dyngen::test
