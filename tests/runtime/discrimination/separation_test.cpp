// SPDX-License-Identifier: MIT
#include "runtime/discrimination/separation.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "runtime/discrimination/separating_trajectory.h"
#include "runtime/excitation/limited_trajectory.h"
#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFar = std::numeric_limits<double>::infinity();

MotionLimits limits() {
  MotionLimits limits;
  limits.lower = Eigen::Vector2d(-2, -2);
  limits.upper = Eigen::Vector2d(2, 2);
  limits.speed = Eigen::Vector2d(2, 3);
  limits.acceleration = Eigen::Vector2d(8, 10);
  limits.torque = VectorXd::Constant(2, kFar);
  return limits;
}

EffectLaw cubic_law() {
  return test::algebraic_law(
      "cubic", {"qd"}, {{"c", EffectRole::kLinear, -kFar, kFar, 0, 0.1}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * v[0] * v[0] * v[0]; });
}

EffectLaw drag_law() {
  return test::algebraic_law(
      "drag", {"qd"}, {{"c", EffectRole::kLinear, -kFar, kFar, 0, 0.1}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * v[0] * std::abs(v[0]); });
}

SeparationProblem problem(EffectInstance finding, std::vector<EffectInstance> rivals) {
  SeparationProblem problem;
  problem.model = test::planar_arm();
  problem.robot = test::planar_arm_tangents();
  problem.beta = test::planar_arm_values();
  problem.finding = std::move(finding);
  problem.rivals = std::move(rivals);
  problem.noise = Eigen::Vector2d(0.2, 0.1);
  problem.still_speed = VectorXd::Constant(2, 0.01);
  problem.rate = 100;
  return problem;
}

PlannedMotion usual(std::uint64_t seed = 1) {
  return random_motion(test::planar_arm(), limits(), 10, seed);
}

TEST(Separation, IsWhatPlainLeastSquaresMisses) {
  SeparationProblem asked =
      problem(test::known(cubic_law(), 1, {0.3}), {test::unknown(drag_law(), 1)});
  asked.still_speed.setZero();
  const Separation found = SeparationCriterion(asked, usual()).at(usual());
  // the same by one fit of all columns, nothing projected
  const JointMotion motion = usual().at(instants(usual(), 1000));
  MatrixXd Y;
  asked.model.regressor(motion.q, motion.dq, motion.ddq, Y);
  const Index nb = asked.model.size();
  MatrixXd W = MatrixXd::Zero(2000, nb + 1);
  W.topLeftCorner(1000, nb) = Y.leftCols(nb) / 0.2;
  W.bottomLeftCorner(1000, nb) = Y.rightCols(nb) / 0.1;
  const auto v = motion.dq.col(1).array();
  W.col(nb).tail(1000) = v * v.abs() / 0.1;
  VectorXd psi = VectorXd::Zero(2000);
  psi.tail(1000) = 0.3 * v * v * v / 0.1;
  const VectorXd missed = psi - W * W.completeOrthogonalDecomposition().solve(psi);
  EXPECT_NEAR(found.least, missed.squaredNorm(), 1e-8 * missed.squaredNorm());
  EXPECT_GT(found.visible, found.least);
  ASSERT_EQ(found.rivals.size(), 1u);
  EXPECT_EQ(found.rivals[0].lambda, found.least);
}

TEST(Separation, IsNothingFromARivalWithTheSameColumns) {
  EffectLaw twin = cubic_law();
  twin.name = "twin";
  const SeparationProblem asked = problem(test::known(cubic_law(), 0, {0.3}),
                                          {test::unknown(drag_law(), 0), test::unknown(twin, 0)});
  const Separation found = SeparationCriterion(asked, usual()).at(usual());
  EXPECT_LT(found.rivals[1].lambda, 1e-12 * found.visible);
  EXPECT_GT(found.rivals[0].lambda, 1);
  EXPECT_EQ(found.least, found.rivals[1].lambda);
  const SeparatingTrajectory none = separate(asked, limits(), {.evaluations = 60});
  EXPECT_FALSE(none.found);
  EXPECT_NE(none.message.find("same columns"), std::string::npos) << none.message;
}

TEST(Separation, CountsSamplesAndNoise) {
  SeparationProblem asked =
      problem(test::known(cubic_law(), 1, {0.3}), {test::unknown(drag_law(), 1)});
  const double once = SeparationCriterion(asked, usual()).at(usual()).least;
  asked.noise *= 2;
  EXPECT_NEAR(SeparationCriterion(asked, usual()).at(usual()).least, once / 4, 1e-6 * once);
  asked.noise /= 2;
  // ten times the rate: looked at 200 times a second, worth 1000
  asked.rate = 1000;
  EXPECT_NEAR(SeparationCriterion(asked, usual()).at(usual()).least, 10 * once, 0.1 * once);
}

TEST(Separation, ShapesOfARivalAreTried) {
  // Stribeck friction of another width is no other effect
  SeparationProblem asked = problem(test::known(test::stribeck_law(), 1, {4, 0.13}),
                                    {test::unknown(test::stribeck_law(), 1)});
  const SeparationCriterion criterion(asked, usual());
  const Separation coarse = criterion.at(usual()), fine = criterion.finely_at(usual());
  EXPECT_LT(coarse.least, 0.5 * coarse.visible);
  EXPECT_LT(fine.least, 0.1 * fine.visible);
  EXPECT_LE(fine.least, coarse.least * (1 + 1e-9));
}

TEST(Separation, StandingJointsSayNothing) {
  const SeparationProblem asked =
      problem(test::known(cubic_law(), 1, {0.3}), {test::unknown(drag_law(), 1)});
  PlannedMotion still = usual();
  still.at = [at = still.at](const VectorXd& time) {
    JointMotion motion = at(time);
    motion.q.setZero();
    motion.dq.setZero();
    motion.ddq.setZero();
    return motion;
  };
  EXPECT_EQ(SeparationCriterion(asked, usual()).at(still).least, 0);
}

TEST(Separation, RefusesWhatDoesNotFit) {
  const EffectInstance finding = test::known(cubic_law(), 1, {0.3});
  EXPECT_THROW(SeparationCriterion(problem(finding, {}), usual()), std::invalid_argument);
  EXPECT_THROW(SeparationCriterion(problem(test::unknown(cubic_law(), 1), {finding}), usual()),
               std::invalid_argument);
  EXPECT_THROW(SeparationCriterion(problem(finding, {test::known(cubic_law(), 2, {1})}), usual()),
               std::invalid_argument);
  SeparationProblem silent = problem(finding, {test::unknown(drag_law(), 1)});
  silent.noise[0] = 0;
  EXPECT_THROW(SeparationCriterion(silent, usual()), std::invalid_argument);
  const SeparationProblem asked = problem(finding, {test::unknown(drag_law(), 1)});
  EXPECT_THROW(separate(asked, limits(), {.duration = -1}), std::invalid_argument);
}

TEST(Separate, IsFartherApartThanRandomMotionsWithinLimitsAndRepeatable) {
  const SeparationProblem asked =
      problem(test::known(cubic_law(), 1, {0.3}), {test::unknown(drag_law(), 1)});
  const SeparatingOptions options{.evaluations = 250};
  const SeparatingTrajectory first = separate(asked, limits(), options);
  ASSERT_TRUE(first.found) << first.message;
  // seen: 7.3 times
  EXPECT_GT(first.separation.least, 3 * first.random.least);
  EXPECT_GE(first.scores.size(), 7u);
  for (std::size_t i = 1; i < first.scores.size(); ++i) {
    EXPECT_LE(first.scores[i].least, first.scores[i - 1].least);
  }
  EXPECT_LE(first.shares.largest(), 1);
  EXPECT_LE(shares_at_rate(asked.model, limits(), first.motion.duration, first.motion.at, 33333)
                .largest(),
            1);
  const SeparatingTrajectory second = separate(asked, limits(), options);
  const VectorXd time = VectorXd::LinSpaced(777, 0, 10);
  EXPECT_EQ(first.motion.at(time).q, second.motion.at(time).q);
  EXPECT_EQ(first.evaluations, second.evaluations);
}

TEST(Separate, HoldsTorqueLimits) {
  SeparationProblem asked =
      problem(test::known(cubic_law(), 1, {0.3}), {test::unknown(drag_law(), 1)});
  MotionLimits tight = limits();
  tight.beta = asked.beta;
  const SeparatingTrajectory free = separate(asked, tight, {.evaluations = 150});
  ASSERT_TRUE(free.found);
  const LimitShares shares = [&] {
    MotionLimits unit = tight;
    unit.torque = VectorXd::Ones(2);
    return shares_at_rate(asked.model, unit, free.motion.duration, free.motion.at, 1000);
  }();
  tight.torque = 0.8 * shares.torque;
  const SeparatingTrajectory held = separate(asked, tight, {.evaluations = 150});
  ASSERT_TRUE(held.found) << held.message;
  EXPECT_LE(held.shares.largest(), 1);
  EXPECT_GT(held.shares.torque.maxCoeff(), 0.3);
}

}  // namespace
}  // namespace dyngen::runtime
