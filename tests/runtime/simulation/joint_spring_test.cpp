// SPDX-License-Identifier: MIT
#include "runtime/simulation/joint_spring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

Twist linear(double load) { return {2e-4 * load, 2e-4}; }
Twist softening(double load) {
  return {1e-4 * load + 1e-8 * load * load * load, 1e-4 + 3e-8 * load * load};
}
/// Twists the other way again beyond 100 N m.
Twist stiffening(double load) {
  return {3e-4 * load - 1e-8 * load * load * load, 3e-4 - 3e-8 * load * load};
}
Twist gap(double load) {
  const double s = std::tanh(load / 0.4);
  return {0.001 * s, 0.001 / 0.4 * (1 - s * s)};
}

TEST(JointSpring, LoadIsTheInverseOfTwist) {
  for (const auto& law : {linear, softening, stiffening, gap}) {
    const JointSpring spring(law, law(0).slope / 1000);
    for (const double load : {-300.0, -99.0, -2.0, -1e-5, 0.0, 1e-9, 0.3, 1.7, 60.0, 500.0}) {
      const double back = spring.load(spring.twist(load).value);
      EXPECT_NEAR(back, load, 1e-9 * std::abs(load) + 1e-15) << law(1).value;
    }
  }
}

TEST(JointSpring, FollowsTheLawWhereItIsNotTooStiff) {
  const JointSpring spring(stiffening, 3e-7);
  for (const double load : {-99.0, -3.0, 0.0, 40.0, 99.0}) {
    EXPECT_EQ(spring.twist(load).value, stiffening(load).value);
    EXPECT_EQ(spring.twist(load).slope, stiffening(load).slope);
  }
  // 3e-4 - 3e-8 load^2 is the floor at 99.95: further load adds twist by it
  const double first = std::sqrt((3e-4 - 3e-7) / 3e-8);
  EXPECT_NEAR(spring.twist(300).value, stiffening(first).value + 3e-7 * (300 - first), 1e-12);
  EXPECT_NEAR(spring.twist(-300).value, -spring.twist(300).value, 1e-15);
}

TEST(JointSpring, AGapHasFlanksThatGive) {
  const JointSpring spring(gap, 2.5e-6);
  EXPECT_LT(spring.load(0.0005), 0.3);
  EXPECT_GT(spring.load(0.0015), 100);
}

TEST(JointSpring, RefusesAFloorThatIsNone) {
  EXPECT_THROW(JointSpring(linear, 0), std::invalid_argument);
  EXPECT_THROW(JointSpring(linear, 3e-4), std::invalid_argument);
  EXPECT_THROW(JointSpring(
                   [](double load) {
                     return Twist{-load, -1};
                   },
                   1e-6),
               std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
