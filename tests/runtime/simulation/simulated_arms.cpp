// SPDX-License-Identifier: MIT
#include "tests/runtime/simulation/simulated_arms.h"

#include <cmath>
#include <numbers>

namespace dyngen::test {

using Eigen::Index;

NumericRobot planar_arm() {
  NumericRobot robot;
  robot.base_acceleration = {0, 9.81, 0};
  const double length = 0.4;
  const double mass[] = {6, 4, 2};
  for (int j = 0; j < 3; ++j) {
    NumericJoint joint;
    joint.parent = j;
    joint.d = j == 0 ? 0 : length;
    const double m = mass[j], half = length / 2;
    joint.inertial = {
        0.01, 0, 0, 0.01 + m * half * half, 0, 0.01 + m * length * length / 3, m * half, 0, 0, m};
    joint.IA = 0.1;
    joint.Fs = 3.0 / (1 + j);
    joint.Fv = 1.0 / (1 + j);
    joint.off = 0.2;
    robot.joints.push_back(joint);
  }
  return robot;
}

NumericRobot slide() {
  NumericJoint joint;
  joint.sigma = 1;
  joint.inertial[9] = 2;
  joint.Fs = 3;
  NumericRobot robot;
  robot.joints = {joint};
  return robot;
}

runtime::Trajectory cosine_trajectory(Index joints, double seconds, double amplitude, double hz) {
  const double step = 0.005;
  const Index samples = 1 + std::lround(seconds / step);
  runtime::Trajectory trajectory;
  trajectory.time.resize(samples);
  for (auto* part : {&trajectory.q, &trajectory.dq, &trajectory.ddq}) part->resize(samples, joints);
  for (Index k = 0; k < samples; ++k) {
    const double t = trajectory.time[k] = static_cast<double>(k) * step;
    for (Index j = 0; j < joints; ++j) {
      const double w = 2 * std::numbers::pi * hz * (1 + 0.3 * static_cast<double>(j));
      trajectory.q(k, j) = amplitude * (1 - std::cos(w * t));
      trajectory.dq(k, j) = amplitude * w * std::sin(w * t);
      trajectory.ddq(k, j) = amplitude * w * w * std::cos(w * t);
    }
  }
  return trajectory;
}

runtime::Trajectory constant_trajectory(const Eigen::VectorXd& q, double seconds) {
  runtime::Trajectory trajectory;
  trajectory.time = Eigen::Vector2d(0, seconds);
  trajectory.q = q.transpose().replicate(2, 1);
  trajectory.dq = trajectory.ddq = Eigen::MatrixXd::Zero(2, q.size());
  return trajectory;
}

}  // namespace dyngen::test
