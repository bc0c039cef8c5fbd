// SPDX-License-Identifier: MIT
#include "runtime/control/velocity_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

TEST(VelocityFilter, FollowsAConstantVelocityExactly) {
  VelocityFilter filter({.sample_time = 0.01, .cutoff_hz = 5}, VectorXd::Zero(1),
                        VectorXd::Constant(1, 2));
  for (int k = 1; k < 50; ++k) {
    const double q = 2 * 0.01 * k;
    EXPECT_NEAR(filter.update(&q)[0], 2, 1e-12);
  }
}

TEST(VelocityFilter, ForgetsAStartWithItsTimeConstant) {
  const double h = 0.001, cutoff = 20;
  VelocityFilter filter({.sample_time = h, .cutoff_hz = cutoff}, VectorXd::Zero(1),
                        VectorXd::Ones(1));
  const double q = 0;
  double velocity = 0;
  for (int k = 0; k < 30; ++k) velocity = filter.update(&q)[0];
  EXPECT_NEAR(velocity, std::exp(-2 * std::numbers::pi * cutoff * 30 * h), 1e-12);
}

TEST(VelocityFilter, IsTheBareDifferenceWithAnInfiniteCutoff) {
  VelocityFilter filter({.sample_time = 0.5, .cutoff_hz = std::numeric_limits<double>::infinity()},
                        VectorXd::Zero(1), VectorXd::Zero(1));
  const double q = 3;
  EXPECT_EQ(filter.update(&q)[0], 6);
  EXPECT_EQ(filter.update(&q)[0], 0);
}

TEST(VelocityFilter, RefusesWrongOptions) {
  EXPECT_THROW(VelocityFilter({.sample_time = 0}, VectorXd::Zero(1), VectorXd::Zero(1)),
               std::invalid_argument);
  EXPECT_THROW(VelocityFilter({.cutoff_hz = 0}, VectorXd::Zero(1), VectorXd::Zero(1)),
               std::invalid_argument);
  EXPECT_THROW(VelocityFilter({}, VectorXd::Zero(1), VectorXd::Zero(2)), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
