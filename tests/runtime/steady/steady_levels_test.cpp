// SPDX-License-Identifier: MIT
#include "runtime/steady/steady_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include "runtime/estimation/distributions.h"
#include "runtime/steady/friction_curve.h"
#include "tests/runtime/steady/made_steady.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double coulomb_viscous(double v) { return (v > 0 ? 3.0 : -3.0) + 4 * v; }

TEST(SteadyRuns, AllRunsAreFoundWithTheirSpeeds) {
  test::MadeJoint joint;
  joint.friction = coulomb_viscous;
  const auto recording = test::made_recording(joint, 1);
  const std::vector<SteadyRun> runs = find_steady_runs(*recording, 0, SteadyRules());
  for (const double speed : joint.speeds) {
    std::size_t found = 0;
    for (const SteadyRun& run : runs) {
      found += std::abs(std::abs(run.speed) - speed) < 2e-3 * speed + 1e-5;
      EXPECT_TRUE(run.alone);
    }
    const auto passes =
        static_cast<std::size_t>(std::clamp(static_cast<int>(6 * speed / 2.5), 1, 4));
    EXPECT_GE(found, 2 * passes) << speed;  // a ramp may split one
  }
}

TEST(SteadyRuns, ASineHasNone) {
  Recording recording;
  constexpr Index kSamples = 4000;
  recording.time = VectorXd::LinSpaced(kSamples, 0, 40);
  recording.q = (2 * recording.time.array()).sin();
  recording.tau = MatrixXd::Zero(kSamples, 1);
  recording.run_starts = {0};
  EXPECT_TRUE(find_steady_runs(recording, 0, SteadyRules()).empty());
}

TEST(SteadyRuns, AJointThatStandsHasNone) {
  test::MadeJoint joint;
  joint.friction = coulomb_viscous;
  EXPECT_TRUE(find_steady_runs(*test::made_recording(joint, 1), 1, SteadyRules()).empty());
}

TEST(SteadyLevels, GravityIsTakenOutWithoutAModel) {
  test::MadeJoint joint;
  joint.friction = coulomb_viscous;
  joint.noise = {.white = 1e-3, .memory = {}, .deviation = {}};
  const SteadyLevels levels =
      steady_levels({{test::made_recording(joint, 1)}, 0, true, {}}, SteadyRules());
  ASSERT_FALSE(levels.levels.empty());
  EXPECT_EQ(levels.postures, 1);
  // all levels less friction are one constant
  const double first = levels.levels[0].torque - coulomb_viscous(levels.levels[0].run.speed);
  for (const SteadyLevel& own : levels.levels) {
    EXPECT_NEAR(own.torque - coulomb_viscous(own.run.speed), first, 2e-3);
  }
}

TEST(SteadyLevels, AnotherJointThatMovesNeedsAModel) {
  test::MadeJoint joint;
  joint.friction = coulomb_viscous;
  Recording moving = *test::made_recording(joint, 1);
  moving.q.col(1) = moving.time.array().sin();
  const auto recording = std::make_shared<const Recording>(moving);
  SteadyInput input{{recording}, 0, true, {}};
  const SteadyLevels none = steady_levels(input, SteadyRules());
  EXPECT_TRUE(none.levels.empty());
  EXPECT_GT(none.left_out, 20);
  input.rest = [&](const Stretch& own) -> VectorXd {
    const auto q = recording->q.col(0).segment(own.first, own.count).array();
    return 12 * q.cos() + 5 * q.sin();
  };
  const SteadyLevels all = steady_levels(input, SteadyRules());
  EXPECT_EQ(static_cast<int>(all.levels.size()), none.left_out);
  for (const SteadyLevel& own : all.levels) {
    EXPECT_NEAR(own.torque, 1.5 + coulomb_viscous(own.run.speed), 0.7) << own.run.speed;
  }
}

TEST(SteadyPoints, IntervalsHoldTheFrictionWithSlowNoise) {
  int held = 0, all = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    test::MadeJoint joint;
    joint.friction = coulomb_viscous;
    const SteadyLevels levels =
        steady_levels({{test::made_recording(joint, seed)}, 0, true, {}}, SteadyRules());
    // the middle of all directions and the friction of each level: the truth has a mean too
    const auto count = static_cast<Index>(levels.levels.size());
    VectorXd off(count);
    for (Index r = 0; r < count; ++r) {
      const SteadyLevel& own = levels.levels[static_cast<std::size_t>(r)];
      off[r] = own.torque - coulomb_viscous(own.run.speed);
    }
    const double t = student_interval(0.95, levels.degrees);
    for (Index r = 0; r < count; ++r) {
      VectorXd weights = VectorXd::Constant(count, -1.0 / static_cast<double>(count));
      weights[r] += 1;
      const double deviation = std::sqrt(weights.dot(levels.covariance * weights));
      held += std::abs(weights.dot(off)) <= t * deviation;
      ++all;
    }
  }
  const double percent = 100.0 * held / all;
  std::cout << "levels, seeds 0 to 99: " << held << " of " << all << " intervals hold, " << percent
            << " %\n";
  EXPECT_GE(percent, 93);
  EXPECT_LE(percent, 97);
}

/// Poses that are held after both sides: friction holds back with the sign of the way to them.
TEST(HeldPoses, HalfOfTheSumIsGravityAndHalfOfTheDifferenceFriction) {
  int held = 0, all = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    std::vector<double> q, torque;
    double at = -1;
    const auto go = [&](double to) {
      const double way = to > at ? 1 : -1;
      while (std::abs(to - at) > 1e-9) {
        at += way * std::min(0.003, std::abs(to - at));
        q.push_back(at);
        torque.push_back(6 * std::cos(at) + way * 2);
      }
    };
    const auto hold = [&](double way) {
      for (int k = 0; k < 200; ++k) {
        q.push_back(at);
        torque.push_back(6 * std::cos(at) + way * 1.3);
      }
    };
    for (const double pose : {-0.5, 0.1, 0.6, 1.1}) {
      go(pose - 0.1);
      go(pose);
      hold(1);
      go(pose + 0.1);
      go(pose);
      hold(-1);
    }
    const auto samples = static_cast<Index>(q.size());
    auto recording = std::make_shared<Recording>();
    recording->time = VectorXd::LinSpaced(samples, 0, 0.01 * static_cast<double>(samples - 1));
    recording->q = Eigen::Map<const VectorXd>(q.data(), samples);
    const VectorXd noise =
        test::noise_of({.white = 0.2, .memory = {0.2}, .deviation = {0.1}}, samples, 0.01, random);
    recording->tau = Eigen::Map<const VectorXd>(torque.data(), samples) + noise;
    recording->run_starts = {0};
    const HeldPairs pairs = held_pairs({recording}, 0, SteadyRules());
    ASSERT_EQ(pairs.pairs.size(), 4U);
    EXPECT_EQ(pairs.one_sided, 0);
    for (const HeldPair& pair : pairs.pairs) {
      const double gravity = 6 * std::cos(pair.q[0]);
      held += pair.gravity.low <= gravity && gravity <= pair.gravity.high;
      EXPECT_NEAR(pair.gravity.value, gravity, 0.3);
      EXPECT_NEAR(pair.friction.value, 1.3, 0.3);
      ++all;
    }
  }
  const double percent = 100.0 * held / all;
  std::cout << "gravity of poses, seeds 0 to 59: " << held << " of " << all << " intervals hold, "
            << percent << " %\n";
  EXPECT_GE(percent, 90);  // 240 intervals: 95 % within 3.6 standard deviations
}

}  // namespace
}  // namespace dyngen::runtime
