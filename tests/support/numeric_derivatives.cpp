// SPDX-License-Identifier: MIT
#include "tests/support/numeric_derivatives.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "tests/support/numeric_dynamics.h"

namespace dyngen::test {
namespace {

/// d f / d x at 0, f of any vector type: (8 (f(h) - f(-h)) - (f(2h) - f(-2h))) / 12 h.
template <typename Function>
auto derivative(const Function& f, long double h) {
  using Value = decltype(f(h));
  return Value((8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h));
}

}  // namespace

std::vector<long double> joint_values(const RobotModel& model, const std::vector<double>& values) {
  std::vector<long double> all(model.joints.size(), 0.0L);
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const int coordinate = model.joints[j].coordinate;
    if (coordinate >= 0) all[j] = values[static_cast<std::size_t>(coordinate)];
  }
  return all;
}

std::array<long double, 6> joint_screw(const NumericRobot& robot, const std::vector<long double>& q,
                                       std::size_t joint, std::size_t link) {
  const auto pose = [&](long double step) {
    std::vector<long double> moved = q;
    moved[joint] += step;
    return forward_kinematics(robot, moved)[link];
  };
  const Transform<long double> rate = derivative(pose, 1e-4L);
  const Eigen::Matrix<long double, 3, 3> skew =
      rate.topLeftCorner<3, 3>() * pose(0).topLeftCorner<3, 3>().transpose();
  return {rate(0, 3), rate(1, 3), rate(2, 3), skew(2, 1), skew(0, 2), skew(1, 0)};
}

std::vector<long double> wrench_torque(const NumericRobot& robot, const std::vector<long double>& q,
                                       const std::array<double, 6>& wrench) {
  using Vector = Eigen::Matrix<long double, 3, 1>;
  using Frame = Transform<long double>;
  const std::vector<Frame> frames = forward_kinematics(robot, q);
  const auto in_base = [&](std::size_t first) -> Vector {
    return frames.back().topLeftCorner<3, 3>() *
           Vector(wrench[first], wrench[first + 1], wrench[first + 2]);
  };
  const Vector force = in_base(0), moment = in_base(3);
  std::vector<long double> torque(robot.size(), 0.0L);
  for (std::size_t link = robot.size(); link > 0;) {  // what carries the last link
    const NumericJoint& joint = robot.joints[link - 1];
    Frame frame = frames[link - 1];
    const std::size_t parent = static_cast<std::size_t>(joint.parent);
    // in standard frames the axis is z of the frame before
    if (robot.standard) frame = parent == 0 ? Frame(Frame::Identity()) : frames[parent - 1];
    const Vector axis = frame.block<3, 1>(0, 2);
    const Vector arm = frames.back().block<3, 1>(0, 3) - frame.block<3, 1>(0, 3);
    if (joint.sigma == 0) torque[link - 1] = axis.dot(moment + arm.cross(force));
    if (joint.sigma == 1) torque[link - 1] = axis.dot(force);
    link = parent;
  }
  return torque;
}

TorqueDerivatives torque_derivatives(const RobotModel& model, NumericRobot robot,
                                     const MotionSample& sample) {
  for (NumericJoint& joint : robot.joints) joint.Fs = 0;
  const std::vector<long double> q = joint_values(model, sample.q);
  const std::vector<long double> dq = joint_values(model, sample.dq);
  const std::vector<long double> ddq = joint_values(model, sample.ddq);
  const auto torque = [&](const auto& positions, const auto& velocities,
                          const auto& accelerations) {
    std::vector<long double> all = id(robot, positions, velocities, accelerations);
    Eigen::Map<Eigen::Matrix<long double, Eigen::Dynamic, 1>> values(
        all.data(), static_cast<Eigen::Index>(all.size()));
    if (!sample.wrench.empty()) {
      std::array<double, 6> wrench{};
      std::copy_n(sample.wrench.begin(), 6, wrench.begin());
      const std::vector<long double> off = wrench_torque(robot, positions, wrench);
      for (std::size_t j = 0; j < all.size(); ++j) all[j] -= off[j];
    }
    return Eigen::Matrix<long double, Eigen::Dynamic, 1>(values);
  };
  const std::size_t n = static_cast<std::size_t>(model.coordinate_count);
  TorqueDerivatives result;
  for (auto* matrix : {&result.position, &result.velocity, &result.acceleration}) {
    matrix->assign(n * n, 0.0L);
  }
  for (std::size_t joint = 0; joint < robot.size(); ++joint) {
    const int column = model.joints[joint].coordinate;
    if (column < 0) continue;
    const auto stepped = [&](std::vector<long double> values, long double step) {
      values[joint] += step;
      return values;
    };
    const auto fill = [&](std::vector<long double>& matrix, const auto& slope) {
      for (std::size_t i = 0; i < robot.size(); ++i) {
        const int row = model.joints[i].coordinate;
        if (row < 0) continue;
        matrix[static_cast<std::size_t>(row) * n + static_cast<std::size_t>(column)] =
            slope(static_cast<Eigen::Index>(i));
      }
    };
    fill(result.position,
         derivative([&](long double h) { return torque(stepped(q, h), dq, ddq); }, 1e-3L));
    fill(result.velocity,
         derivative([&](long double h) { return torque(q, stepped(dq, h), ddq); }, 0.125L));
    fill(result.acceleration,
         derivative([&](long double h) { return torque(q, dq, stepped(ddq, h)); }, 0.125L));
  }
  return result;
}

}  // namespace dyngen::test
