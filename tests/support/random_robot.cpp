// SPDX-License-Identifier: MIT
#include "tests/support/random_robot.h"

#include <rapidcheck.h>

#include <cmath>

namespace dyngen::test {
namespace {

double thousandths(int range) { return *rc::gen::inRange(-range, range + 1) / 1000.0; }

/// Angles that matter to pruning: right ones, straight ones, 60 degrees, and any.
double random_angle() {
  const double pi = std::acos(-1.0);
  switch (*rc::gen::inRange(0, 7)) {
    case 0:
    case 1:
      return 0;
    case 2:
      return pi / 2;
    case 3:
      return -pi / 2;
    case 4:
      return pi;
    case 5:
      return pi / 3;
    default:
      return thousandths(3000);
  }
}

/// Zero half of the time.
double random_or_zero(int range) { return *rc::gen::arbitrary<bool>() ? thousandths(range) : 0.0; }

}  // namespace

NumericRobot random_robot() {
  NumericRobot robot;
  robot.standard = *rc::gen::arbitrary<bool>();
  const int joints = *rc::gen::inRange(1, 13);
  const bool tree = *rc::gen::inRange(0, 4) == 0;
  for (int j = 1; j <= joints; ++j) {
    NumericJoint joint;
    const int kind = *rc::gen::inRange(0, 10);
    joint.sigma = kind < 7 ? 0 : kind < 9 ? 1 : 2;
    if (j == joints && kind == 9) joint.sigma = 0;  // something must move
    joint.parent = tree ? *rc::gen::inRange(0, j) : j - 1;
    joint.alpha = random_angle();
    joint.theta = random_angle();
    joint.d = random_or_zero(800);
    joint.r = random_or_zero(800);
    for (double& value : joint.inertial) value = random_or_zero(2000);
    if (joint.sigma != 2) {
      joint.IA = random_or_zero(1000);
      joint.Fs = random_or_zero(1000);
      joint.Fv = random_or_zero(1000);
      joint.off = random_or_zero(1000);
    }
    robot.joints.push_back(joint);
  }
  robot.base_acceleration = {random_or_zero(9810), random_or_zero(9810), random_or_zero(9810)};
  return robot;
}

}  // namespace dyngen::test
