// SPDX-License-Identifier: MIT
#include "tests/blind/reach/reach.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace blind {
namespace {

namespace runtime = dyngen::runtime;
namespace test = dyngen::test;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr unsigned kSeed = 31;

std::vector<runtime::EffectInstance> spring(double stiffness) {
  return {test::known(test::spring_law(), 1, {stiffness})};
}

Reach reach_with(double stiffness) {
  const auto effects = spring(stiffness);
  return reach_of(
      test::arm_input(test::two_recordings(effects, kSeed), effects, {test::spring_law()}),
      test::two_recordings({}, kSeed));
}

/// Squares of the spring's torque that least squares leave, in units of the arm's noise: equations
/// of all samples, which are white.
double left_by_least_squares(double stiffness) {
  const auto with = test::arm_recordings(test::two_recordings(spring(stiffness), kSeed));
  const auto without = test::arm_recordings(test::two_recordings({}, kSeed));
  const Index joints = with.joints(), size = with.model.size();
  MatrixXd Y(joints * with.equations(), size);
  VectorXd torque(Y.rows());
  Index at = 0;
  for (std::size_t r = 0; r < with.runs.size(); ++r) {
    const runtime::RowBlock &rows = with.runs[r].rows, &bare = without.runs[r].rows;
    for (Index j = 0; j < joints; ++j) {
      Y.middleRows(at, rows.Y.rows()) = rows.Y.middleCols(j * size, size);
      torque.segment(at, rows.Y.rows()) = rows.tau.col(j) - bare.tau.col(j);
      at += rows.Y.rows();
    }
  }
  const VectorXd left = torque - Y * Y.completeOrthogonalDecomposition().solve(torque);
  return left.squaredNorm() / (test::kArmNoise * test::kArmNoise);
}

TEST(Reach, IsWhatLeastSquaresLeaveInUnitsOfTheNoise) {
  for (const double stiffness : {0.02, 0.06}) {
    const Reach reach = reach_with(stiffness);
    const double expected = left_by_least_squares(stiffness);
    ASSERT_GT(expected, 5);
    EXPECT_NEAR(reach.lambda / expected, 1, 0.15) << stiffness;
    // with a standard deviation of 1
    EXPECT_NEAR(std::sqrt(reach.found), std::sqrt(reach.seen), 3) << stiffness;
    EXPECT_LE(reach.seen, 1.05 * reach.lambda);
    EXPECT_EQ(reach.repeating, 0);  // no motion repeats
    EXPECT_GT(reach.needed, 10);
    EXPECT_LT(reach.needed, 40);
  }
}

TEST(Reach, OfAFunctionOfTheMotionAllComesBackWhereTheMotionDoes) {
  const auto effects = spring(0.06);
  // three periods of 8 s
  const double speed = 2.5 * std::acos(-1.0);
  const auto moved = [&](const std::vector<runtime::EffectInstance>& left_out) {
    return test::measured({test::sines(24, 0.01, 0.3, speed), test::sines(24, 0.01, 2.3, speed)},
                          test::planar_arm_values(), left_out, test::kArmNoise, 0, kSeed);
  };
  const Reach reach =
      reach_of(test::arm_input(moved(effects), effects, {test::spring_law()}), moved({}));
  ASSERT_GT(reach.seen, 5);
  EXPECT_GE(reach.repeating, 0.95 * reach.seen);
  EXPECT_LE(reach.repeating, 1.001 * reach.seen);
}

}  // namespace
}  // namespace blind
