// SPDX-License-Identifier: MIT
#include "runtime/recordings/clipping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dyngen::test {
namespace {

using runtime::Clipping;
using runtime::find_clipping;

/// 10 sin, a slow crest; with noise of deviation `noise`, in steps of `step` (0: none).
Eigen::VectorXd torque(double noise, double step) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  Eigen::VectorXd tau(4000);
  for (Eigen::Index k = 0; k < tau.size(); ++k) {
    tau(k) = 10 * std::sin(0.005 * static_cast<double>(k)) + noise * normal(generator);
    if (step > 0) tau(k) = std::round(tau(k) / step) * step;
  }
  return tau;
}

TEST(Clipping, IsFoundAtEitherEnd) {
  const Clipping upper = find_clipping(torque(0.2, 0).cwiseMin(8));
  EXPECT_TRUE(upper.clipped);
  EXPECT_EQ(upper.upper, 8);
  EXPECT_GT(upper.at_upper, 500);
  EXPECT_EQ(upper.at_lower, 1);
  const Clipping lower = find_clipping(torque(0.2, 0.05).cwiseMax(-9));
  EXPECT_TRUE(lower.clipped);
  EXPECT_EQ(lower.lower, -9);
}

TEST(Clipping, IsNotTheCrestOfAQuantisedSignal) {
  for (const double step : {0.01, 0.05, 0.1, 0.3, 0.7, 1.0}) {
    EXPECT_FALSE(find_clipping(torque(0, step)).clipped) << step;
    EXPECT_FALSE(find_clipping(torque(0.2, step)).clipped) << step;
  }
  EXPECT_FALSE(find_clipping(torque(0, 0)).clipped);
  EXPECT_FALSE(find_clipping(torque(0.2, 0)).clipped);
}

TEST(Clipping, IsNotAConstantOrAZero) {
  EXPECT_FALSE(find_clipping(Eigen::VectorXd::Constant(100, 3)).clipped);
  EXPECT_FALSE(find_clipping(torque(0.2, 0).cwiseMax(0)).clipped);
  EXPECT_FALSE(find_clipping(Eigen::VectorXd()).clipped);
}

}  // namespace
}  // namespace dyngen::test
