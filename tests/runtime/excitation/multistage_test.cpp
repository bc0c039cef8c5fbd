// SPDX-License-Identifier: MIT
#include "runtime/excitation/multistage.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "runtime/excitation/chosen_points.h"
#include "tests/runtime/excitation/small_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

HeldAccelerations some_accelerations() {
  HeldAccelerations held{.sample_time = 0.01, .start = Eigen::Vector2d(0.1, -0.2)};
  std::srand(5);
  held.u = MatrixXd::Random(40, 2);
  return held;
}

TEST(HeldAccelerations, MoveAsADoubleIntegrator) {
  HeldAccelerations held{.sample_time = 0.01, .start = Eigen::Vector2d(1, 2)};
  held.u = MatrixXd::Constant(101, 2, 3.0);
  const JointMotion motion = held.motion();
  EXPECT_NEAR(motion.dq(100, 0), 3.0, 1e-12);
  EXPECT_NEAR(motion.q(100, 1), 2 + 1.5, 1e-12);
  EXPECT_EQ(motion.q(0, 0), 1);
}

TEST(HeldAccelerations, ResampledAreTheSameMotion) {
  const HeldAccelerations held = some_accelerations();
  const JointMotion coarse = held.motion(), fine = resampled(held, 5).motion();
  ASSERT_EQ(fine.q.rows(), 5 * coarse.q.rows());
  for (Index k = 0; k < coarse.q.rows(); ++k) {
    EXPECT_LT((fine.q.row(5 * k) - coarse.q.row(k)).norm(), 1e-12);
    EXPECT_LT((fine.dq.row(5 * k) - coarse.dq.row(k)).norm(), 1e-12);
  }
}

TEST(HeldAccelerations, AreBroughtToRestWithinLimits) {
  const LinearModel model = test::small_arm();
  MotionLimits limits = test::small_arm_limits();
  HeldAccelerations held{.sample_time = 0.01, .start = Eigen::Vector2d(0, 0)};
  held.u = MatrixXd::Constant(60, 2, 2.0);
  const std::optional<HeldAccelerations> whole = brought_to_rest(model, limits, held);
  ASSERT_TRUE(whole.has_value());
  const JointMotion motion = whole->motion();
  EXPECT_LT(motion.dq.bottomRows(1).norm(), 1e-12);
  EXPECT_EQ(motion.ddq.bottomRows(1).norm(), 0);
  EXPECT_LE(limit_shares(model, limits, motion).largest(), 1);
  EXPECT_EQ(whole->u.topRows(60), held.u);  // there is room: nothing is cut off

  // at the end it is 0.36 rad on its way with 1.2 rad/s; braking with 2 rad/s^2 takes as far again
  limits.upper[0] = 0.5;
  limits.lower[0] = -0.5;
  limits.acceleration[0] = 2.01;
  const std::optional<HeldAccelerations> earlier = brought_to_rest(model, limits, held);
  ASSERT_TRUE(earlier.has_value());
  EXPECT_LT(earlier->u.rows(), whole->u.rows() + 60);
  EXPECT_LT(earlier->u(59, 0), 0);
  EXPECT_LE(limit_shares(model, limits, earlier->motion()).largest(), 1);

  limits.acceleration[0] = 0.1;
  EXPECT_FALSE(brought_to_rest(model, limits, held).has_value());
}

TEST(AdjointSweep, EqualsDifferences) {
  const HeldAccelerations held = some_accelerations();
  const JointMotion weights{MatrixXd::Random(40, 2), MatrixXd::Random(40, 2),
                            MatrixXd::Random(40, 2)};
  // a sum that is linear in the motion: the partial derivatives are its weights
  const auto s = [&](const HeldAccelerations& at) {
    const JointMotion motion = at.motion();
    return weights.q.cwiseProduct(motion.q).sum() + weights.dq.cwiseProduct(motion.dq).sum() +
           weights.ddq.cwiseProduct(motion.ddq).sum();
  };
  const MatrixXd gradient = adjoint_sweep(weights, held.sample_time);
  for (const Index k : {0, 1, 20, 39}) {
    for (Index j = 0; j < 2; ++j) {
      HeldAccelerations after = held;
      after.u(k, j) += 1;
      EXPECT_NEAR(s(after) - s(held), gradient(k, j), 1e-10) << k;
    }
  }
}

TEST(ThroughChosenPoints, StartsAtRestAndKeepsLimits) {
  const LinearModel model = test::small_arm();
  const MotionLimits limits = test::small_arm_limits();
  const HeldAccelerations held = through_chosen_points(model, limits, {}, {.seed = 3});
  const JointMotion motion = held.motion();
  EXPECT_EQ(motion.dq.row(0).norm(), 0);
  EXPECT_LE(limit_shares(model, limits, motion).largest(), 1);
  EXPECT_GT(motion.q.col(0).maxCoeff() - motion.q.col(0).minCoeff(), 0.2);
  EXPECT_THROW(through_chosen_points(model, limits, {}, {.points = 0}), std::invalid_argument);
}

TEST(Multistage, LowersTheCostEveryTimeWithinLimits) {
  const LinearModel model = test::small_arm();
  const MotionLimits limits = test::small_arm_limits();
  const MultistageResult result =
      multistage(model, limits, through_chosen_points(model, limits, {}, {.samples = 300}),
                 {.iterations = 40});
  ASSERT_GE(result.cost.size(), 10U) << result.ended;
  for (std::size_t i = 1; i < result.cost.size(); ++i) {
    EXPECT_LT(result.total[i], result.total[i - 1]);
  }
  EXPECT_LT(result.cost.back(), 0.5 * result.cost.front());
  EXPECT_LE(result.shares.largest(), 1);
}

/// The first step goes along the gradient: the cost along it falls by step times gradient, which
/// the cost's own differences confirm.
TEST(Multistage, FirstStepIsAlongTheGradientOfTheCost) {
  const LinearModel model = test::small_arm();
  const MotionLimits limits = test::small_arm_limits();
  const HeldAccelerations start = through_chosen_points(model, limits, {}, {.samples = 60});
  // with the same weights for every start: parts of a cost that is the same
  const auto cost = [&](const MatrixXd& u) {
    HeldAccelerations at = start;
    at.u = u;
    return multistage(model, limits, at,
                      {.iterations = 0, .acceleration_share = 0, .barrier_share = 0})
        .total[0];
  };
  const double size = 1e-6;
  const MultistageResult result = multistage(
      model, limits, start,
      {.iterations = 1, .first_change = size, .acceleration_share = 0, .barrier_share = 0});
  const MatrixXd direction = (start.u - result.trajectory.u) / size;
  ASSERT_NEAR(direction.cwiseAbs().maxCoeff(), 1, 1e-6);
  const double h = 1e-4;
  MatrixXd differences(direction.rows(), direction.cols());
  for (Index k = 0; k < direction.size(); ++k) {
    MatrixXd after = start.u, before = start.u;
    after.data()[k] += h;
    before.data()[k] -= h;
    differences.data()[k] = (cost(after) - cost(before)) / (2 * h);
  }
  differences /= differences.cwiseAbs().maxCoeff();
  EXPECT_LT((direction - differences).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(Multistage, EndsWhereNoStepKeepsTheLimits) {
  const LinearModel model = test::small_arm();
  MotionLimits limits = test::small_arm_limits();
  const HeldAccelerations start = through_chosen_points(model, limits, {}, {.samples = 300});
  const LimitShares used = limit_shares(model, limits, start.motion());
  // no more than the start uses
  limits.acceleration = limits.acceleration.cwiseProduct(used.acceleration) * (1 + 1e-9);
  const MultistageResult result =
      multistage(model, limits, start, {.iterations = 1000, .barrier_share = 0});
  EXPECT_LE(result.shares.largest(), 1);
  EXPECT_NE(result.ended.find("no step"), std::string::npos) << result.ended;
  limits.acceleration *= 0.5;
  EXPECT_THROW(multistage(model, limits, start, {}), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
