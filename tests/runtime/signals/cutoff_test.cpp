// SPDX-License-Identifier: MIT
#include "runtime/signals/cutoff.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <random>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

/// Sines up to 5 Hz that are in step with nothing.
Eigen::VectorXd multisine(double T, Eigen::Index N, double highest_hz = 5) {
  Eigen::VectorXd q(N);
  for (Eigen::Index k = 0; k < N; ++k) {
    q[k] = 0;
    for (int line = 1; line <= 6; ++line) {
      const double hz = highest_hz * std::pow(line / 6.0, 1.3);
      q[k] += 0.3 / line *
              std::sin(2 * std::numbers::pi * hz * T * static_cast<double>(k) + line * line);
    }
  }
  return q;
}

Eigen::VectorXd through_encoder(const Eigen::VectorXd& q, double step) {
  return step * (q / step).array().round();
}

TEST(Cutoff, LiesAboveTheMotionAndBelowTheNoise) {
  for (const double duration : {3.0, 10.0, 30.0}) {
    const Eigen::VectorXd q =
        through_encoder(multisine(1e-3, static_cast<Eigen::Index>(duration * 1e3)), 1e-4);
    const Cutoff cutoff = choose_cutoff(q, 1e-3);
    EXPECT_GT(cutoff.hz, 5) << cutoff.message;
    EXPECT_LT(cutoff.hz, 40) << cutoff.message;
    std::cout << duration << " s: " << cutoff.message << "\n";
  }
}

TEST(Cutoff, FollowsTheBandwidth) {
  // An encoder that slow motion passes in long steps has no white noise: below 3 Hz it is found
  // late.
  for (const double bandwidth : {3.0, 10.0, 30.0}) {
    const Eigen::VectorXd q = through_encoder(multisine(1e-3, 10000, bandwidth), 1e-4);
    const Cutoff cutoff = choose_cutoff(q, 1e-3);
    EXPECT_GT(cutoff.hz, 1.5 * bandwidth) << cutoff.message;
    EXPECT_LT(cutoff.hz, 6 * bandwidth) << cutoff.message;
  }
}

TEST(Cutoff, GoesOnAboveAGapAndLeavesVibrationAlone) {
  const double T = 1e-3;
  Eigen::VectorXd two(20000), shaken(20000);
  for (Eigen::Index k = 0; k < two.size(); ++k) {
    const double angle = 2 * std::numbers::pi * T * static_cast<double>(k);
    two[k] = 0.3 * std::sin(angle) + 0.01 * std::sin(12.1 * angle);
    shaken[k] = 0.3 * std::sin(angle) + 2e-5 * std::sin(60 * angle);  // 6 % of the power
  }
  EXPECT_GT(choose_cutoff(through_encoder(two, 1e-5), T).hz, 15);
  const Cutoff cutoff = choose_cutoff(through_encoder(shaken, 1e-5), T);
  EXPECT_LT(cutoff.hz, 50) << cutoff.message;
}

TEST(Cutoff, WithoutNoiseIsTheUpperLimit) {
  const Cutoff cutoff = choose_cutoff(multisine(1e-3, 10000), 1e-3);
  EXPECT_EQ(cutoff.hz, 200) << cutoff.message;
  EXPECT_NE(cutoff.message.find("no noise"), std::string::npos);
}

TEST(Cutoff, AJointThatDoesNotMoveHasNoSay) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0, 1e-4);
  Eigen::MatrixXd q(10000, 3);
  q.col(0) = through_encoder(multisine(1e-3, 10000), 1e-4);
  q.col(1).setConstant(0.7);
  for (Eigen::Index k = 0; k < q.rows(); ++k) q(k, 2) = normal(random);
  EXPECT_EQ(choose_cutoff(q, 1e-3).hz, choose_cutoff(q.col(0), 1e-3).hz);
  const Cutoff still = choose_cutoff(q.rightCols(2), 1e-3);
  EXPECT_EQ(still.hz, 2);
  EXPECT_NE(still.message.find("no joint moves"), std::string::npos);
}

// a drive that holds its joint gives way, smoothly and far above the encoder's steps
TEST(Cutoff, AJointThatGivesWayHasNoSay) {
  Eigen::MatrixXd q(10000, 2);
  q.col(0) = through_encoder(multisine(1e-3, 10000), 1e-5);
  for (Eigen::Index k = 0; k < q.rows(); ++k) {
    q(k, 1) = 1e-4 * std::sin(2 * std::numbers::pi * 120e-3 * static_cast<double>(k));
  }
  EXPECT_GT(choose_cutoff(q.col(1), 1e-3).hz, 100);
  EXPECT_EQ(choose_cutoff(q, 1e-3).hz, choose_cutoff(q.col(0), 1e-3).hz);
  // as large a part of the way is motion
  q.col(1) *= 100;
  EXPECT_GT(choose_cutoff(q, 1e-3).hz, 100);
}

TEST(Cutoff, TooLittleDataIsRefused) {
  EXPECT_THROW(choose_cutoff(Eigen::MatrixXd::Zero(63, 1), 1e-3), std::invalid_argument);
  EXPECT_THROW(choose_cutoff(Eigen::MatrixXd::Zero(100, 0), 1e-3), std::invalid_argument);
  EXPECT_THROW(choose_cutoff(Eigen::MatrixXd::Zero(100, 1), 0), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
