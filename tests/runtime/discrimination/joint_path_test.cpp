// SPDX-License-Identifier: MIT
#include "runtime/discrimination/joint_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dyngen::runtime {
namespace {

TEST(JointPath, KeepsSpeedAccelerationAndEnds) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 200; ++i) {
    const double from = uniform(random), to = from + 2 * uniform(random) - 1;
    const double speed = std::pow(10, -2 + 3 * uniform(random));
    const double acceleration = std::pow(10, -1 + 3 * uniform(random));
    JointPath path(from);
    path.move(to, speed, acceleration);
    EXPECT_NEAR(path.duration(), stroke_time(std::abs(to - from), speed, acceleration), 1e-12);
    EXPECT_GE(path.duration(), 0.2);
    constexpr int kParts = 2000;
    for (int k = 0; k <= kParts; ++k) {
      const JointPath::Instant at = path.at(path.duration() * k / kParts);
      ASSERT_LE(std::abs(at.dq), speed * (1 + 1e-12));
      ASSERT_LE(std::abs(at.ddq), acceleration * (1 + 1e-12));
      ASSERT_GE(at.q, std::min(from, to) - 1e-12);
      ASSERT_LE(at.q, std::max(from, to) + 1e-12);
    }
    EXPECT_NEAR(path.at(path.duration()).q, to, 1e-12);
    EXPECT_NEAR(path.at(path.duration() * (1 - 1e-9)).q, to, 1e-6);
    EXPECT_EQ(path.at(-1).q, from);
  }
}

TEST(JointPath, SpeedAndAccelerationAreDerivatives) {
  JointPath path(0.2);
  path.move(1.3, 0.7, 3);
  path.wait_until(4);
  path.move(1.2, 2, 9);
  path.move(-0.5, 0.1, 3);
  constexpr double kStep = 1e-5;
  for (double t = 0.01; t < path.duration(); t += 0.013) {
    const JointPath::Instant before = path.at(t - kStep), at = path.at(t),
                             after = path.at(t + kStep);
    EXPECT_NEAR(at.dq, (after.q - before.q) / (2 * kStep), 1e-5) << t;
    EXPECT_NEAR(at.ddq, (after.dq - before.dq) / (2 * kStep), 2e-2) << t;
  }
}

TEST(JointPath, PatternsFillTheTimeAndComeBack) {
  for (const double until : {0.3, 1.0, 7.7, 40.0}) {
    JointPath path(0.4);
    fill(path, until, [](JointPath& p, double size) {
      p.move(0.4 + size, 0.5, 4);
      p.move(0.4 - size, 0.5, 4);
      p.move(0.4, 0.5, 4);
    });
    EXPECT_NEAR(path.duration(), until, 1e-9);
    EXPECT_EQ(path.position(), 0.4);
    double moved = 0;
    for (int k = 0; k < 1000; ++k) moved += path.at(until * k / 1000).dq != 0 ? 1e-3 : 0;
    // three strokes of two ramps take 0.6 s at least
    EXPECT_GT(moved, until > 0.7 ? 0.8 : -1) << until;
  }
}

}  // namespace
}  // namespace dyngen::runtime
