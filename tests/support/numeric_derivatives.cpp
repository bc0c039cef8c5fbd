// SPDX-License-Identifier: MIT
#include "tests/support/numeric_derivatives.h"

#include <Eigen/Core>

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

}  // namespace dyngen::test
