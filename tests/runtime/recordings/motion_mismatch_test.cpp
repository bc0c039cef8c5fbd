// SPDX-License-Identifier: MIT
#include "runtime/recordings/motion_mismatch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// A motion of two joints that does not repeat, from a time on. The third joint stands.
MatrixXd motion(double begin, Index rows, unsigned seed, double noise) {
  constexpr double kStep = 0.004;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  MatrixXd q(rows, 3);
  for (Index k = 0; k < rows; ++k) {
    const double t = begin + kStep * static_cast<double>(k);
    q.row(k) << std::sin(1.3 * t) + 0.4 * std::sin(3.1 * t + 1), 0.5 * std::cos(1.9 * t) + 0.1 * t,
        0.7;
    for (Index j = 0; j < 3; ++j) q(k, j) += noise * normal(random);
  }
  return q;
}

TEST(CompareMotions, FindsTheLagBetweenSamples) {
  for (const Index rows : {Index{900}, Index{5200}}) {
    for (const double samples : {0.0, 3.0, -7.0, 12.4, -150.7}) {
      const MatrixXd first = motion(0, rows, 1, 1e-4);
      const MatrixXd other = motion(0.004 * samples, rows - 30, 2, 1e-4);
      const SameMotion same = compare_motions(first, other);
      EXPECT_LE(same.mismatch, kJustRepeats) << samples;
      EXPECT_NEAR(same.lag, samples, 0.05);
    }
  }
}

TEST(CompareMotions, AnotherMotionIsAnother) {
  const MatrixXd first = motion(0, 900, 1, 1e-4);
  MatrixXd other = motion(0, 900, 2, 1e-4);
  other.col(1) *= 1.05;
  EXPECT_GT(compare_motions(first, other).mismatch, kJustRepeats);
  other = motion(0, 900, 2, 1e-4);
  other.col(0).array() += 0.1;  // the same form at another place
  EXPECT_GT(compare_motions(first, other).mismatch, kJustRepeats);
  EXPECT_GT(compare_motions(first, motion(400, 900, 2, 1e-4)).mismatch, kJustRepeats);
  EXPECT_GT(compare_motions(MatrixXd::Zero(900, 3), MatrixXd::Zero(900, 3)).mismatch, kJustRepeats);
  EXPECT_GT(compare_motions(first, first.topRows(5)).mismatch, kJustRepeats);
}

}  // namespace
}  // namespace dyngen::runtime
