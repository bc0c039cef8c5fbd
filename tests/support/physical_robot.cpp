// SPDX-License-Identifier: MIT
#include "tests/support/physical_robot.h"

#include <cmath>
#include <random>

namespace dyngen::test {

NumericRobot physical_robot(unsigned seed, int joints) {
  std::mt19937 random(seed);
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto whole = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  const double right = std::acos(0.0);
  NumericRobot robot;
  robot.standard = whole(0, 2) == 0;
  for (int j = 1; j <= joints; ++j) {
    NumericJoint joint;
    const int kind = whole(0, 9);
    joint.sigma = kind < 7 || j == 1 ? 0 : kind < 9 ? 1 : 2;
    joint.parent = seed % 3 == 0 ? j - 1 : whole(j > 1 ? 1 : 0, j - 1);
    joint.alpha = whole(0, 3) == 0 ? number(-2, 2) : right * whole(-1, 2);
    joint.theta = whole(0, 1) == 0 ? 0 : number(-2, 2);
    joint.d = whole(0, 1) == 0 ? 0 : number(-0.5, 0.5);
    joint.r = whole(0, 1) == 0 ? 0 : number(-0.5, 0.5);
    auto& [XX, XY, XZ, YY, YZ, ZZ, MX, MY, MZ, M] = joint.inertial;
    for (int point = 0; point < 5; ++point) {
      const double m = number(0.2, 2), x = number(-0.3, 0.3), y = number(-0.3, 0.3),
                   z = number(-0.3, 0.3);
      XX += m * (y * y + z * z);
      YY += m * (x * x + z * z);
      ZZ += m * (x * x + y * y);
      XY -= m * x * y;
      XZ -= m * x * z;
      YZ -= m * y * z;
      MX += m * x;
      MY += m * y;
      MZ += m * z;
      M += m;
    }
    if (joint.sigma != 2) {
      joint.IA = number(0, 0.5);
      joint.Fs = number(0, 1);
      joint.Fv = number(0, 1);
      joint.off = number(-1, 1);
    }
    robot.joints.push_back(joint);
  }
  robot.base_acceleration = {number(-9, 9), number(-9, 9), 9.81};
  return robot;
}

}  // namespace dyngen::test
