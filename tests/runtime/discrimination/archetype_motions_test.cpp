// SPDX-License-Identifier: MIT
#include "runtime/discrimination/archetype_motions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "runtime/discrimination/separating_trajectory.h"
#include "runtime/excitation/limited_trajectory.h"
#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

MotionLimits limits(double speed) {
  MotionLimits limits;
  limits.lower = Eigen::Vector2d(-2, -1);
  limits.upper = Eigen::Vector2d(2, 1.5);
  limits.speed = Eigen::Vector2d(speed, speed);
  limits.acceleration = Eigen::Vector2d(8, 10);
  limits.torque = VectorXd::Constant(2, std::numeric_limits<double>::infinity());
  return limits;
}

TEST(Archetypes, StandInTheirOrderAndKnowAFamilyOnce) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < archetypes().size(); ++i) {
    const ArchetypeWords& words = archetypes()[i];
    EXPECT_EQ(static_cast<std::size_t>(words.archetype), i);
    EXPECT_FALSE(words.motion.empty());
    for (const std::string& family : words.families) EXPECT_TRUE(seen.insert(family).second);
  }
  EXPECT_EQ(archetype_for({"stribeck", "presliding"}).archetype, Archetype::kNestedReversals);
  EXPECT_EQ(archetype_for({"thermal_drift"}).archetype, Archetype::kColdAndWarm);
  EXPECT_EQ(archetype_for({"no such family"}).archetype, Archetype::kSlowSweep);
}

TEST(ArchetypeMotions, KeepLimitsAndComeBackWhateverTheirNumbers) {
  const LinearModel model = test::planar_arm();
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double speed : {3.0, std::numeric_limits<double>::infinity()}) {
    const MotionLimits within = limits(speed);
    for (const int joint : {-1, 0, 1}) {
      for (const ArchetypeMotion& archetype : archetype_motions(within, joint, 10, 1)) {
        for (int i = 0; i < 5; ++i) {
          VectorXd x = archetype.start;
          if (i > 0) {
            for (double& value : x) value = uniform(random);
          }
          const PlannedMotion motion = archetype.motion(x, within);
          EXPECT_EQ(motion.duration, 10);
          // sines may be 0.3 % higher between the instants at which they were made, and keep 2 %
          EXPECT_LE(shares_at_rate(model, within, motion.duration, motion.at, 777.7).largest(),
                    1 + 1e-12)
              << words_of(archetype.archetype).motion << " of joint " << joint + 1;
          const JointMotion ends = motion.at(Eigen::Vector2d(0, 10));
          EXPECT_LT((ends.q.row(0) - ends.q.row(1)).norm(), 1e-9);
          EXPECT_LT(ends.dq.norm() + ends.ddq.norm(), 1e-8);
        }
      }
    }
  }
}

TEST(ArchetypeMotions, OnlyTheJointThatMattersMoves) {
  int alone = 0;
  for (const ArchetypeMotion& archetype : archetype_motions(limits(3), 1, 10, 1)) {
    if (archetype.joint < 0 || archetype.archetype == Archetype::kTwoLoads) continue;
    EXPECT_EQ(archetype.joint, 1);
    const JointMotion motion =
        archetype.motion(archetype.start, limits(3)).at(VectorXd::LinSpaced(500, 0, 10));
    EXPECT_EQ(motion.dq.col(0).norm(), 0);
    EXPECT_GT(motion.dq.col(1).norm(), 0.1);
    ++alone;
  }
  EXPECT_GE(alone, 15);
}

TEST(ArchetypeMotions, TwoLoadsChangeThePostureOfTheOtherJoints) {
  double most = 0;
  for (const ArchetypeMotion& archetype : archetype_motions(limits(3), 1, 10, 1)) {
    if (archetype.archetype != Archetype::kTwoLoads) continue;
    const JointMotion motion =
        archetype.motion(archetype.start, limits(3)).at(Eigen::Vector2d(1, 6));
    most = std::max(most, std::abs(motion.q(0, 0) - motion.q(1, 0)));
  }
  EXPECT_GT(most, 0.5);
}

}  // namespace
}  // namespace dyngen::runtime
