// SPDX-License-Identifier: MIT
#include "runtime/wind_up/gear_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

struct Sweep {
  VectorXd q, dq;

  explicit Sweep(double travel, Index samples = 5000) : q(samples), dq(samples) {
    for (Index k = 0; k < samples; ++k) {
      const double t = 0.004 * static_cast<double>(k);
      q[k] = travel / 2 * std::sin(t);
      dq[k] = travel / 2 * std::cos(t);
    }
  }
};

VectorXd noise(Index samples, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  return VectorXd::NullaryExpr(samples, [&] { return normal(random); });
}

TEST(GearLines, OrdersBeginWherePeriodsInTheTravelCanBeTold) {
  const Sweep sweep(1.0);
  const OrderRange orders = orders_seen(sweep.q, sweep.dq, 0.004, 2.5);
  EXPECT_NEAR(orders.resolution, 6.283, 0.01);
  EXPECT_NEAR(orders.least, 2.5 * orders.resolution, 1e-9);
  // a quarter of a period per sample at nine tenths of the speeds
  EXPECT_GT(orders.most, 0.9 * std::acos(-1.0) / 2 / (0.5 * 0.004));
}

TEST(GearLines, AFullTurnShowsTheSecondOrder) {
  EXPECT_LT(orders_seen(Sweep(20.0).q, Sweep(20.0).dq, 0.004, 2.5).least, 2);
}

TEST(GearLines, TheStrongestStandsOutOfWhiteNoise) {
  const Sweep sweep(1.5);
  const OrderRange orders = orders_seen(sweep.q, sweep.dq, 0.004, 2.5);
  const VectorXd line = (101.0 * sweep.q.array()).sin();
  const auto found = strongest_line(sweep.q, noise(5000, 3) + 0.4 * line, orders, 20);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->order, 101, orders.resolution / 2);
  EXPECT_LT(found->chance, 1e-6);
  // its amplitude follows from its power
  EXPECT_NEAR(2 * std::sqrt(found->power) / 5000, 0.4, 0.04);
}

TEST(GearLines, OfNoiseTheChanceIsRarelySmall) {
  const Sweep sweep(1.5);
  const OrderRange orders = orders_seen(sweep.q, sweep.dq, 0.004, 2.5);
  int small = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    small += strongest_line(sweep.q, noise(5000, seed), orders, 10)->chance < 0.05;
  }
  EXPECT_LE(small, 21);  // of 200 at 5 %: more once in 1000
}

TEST(GearLines, TooLittleTravelHasNone) {
  const Sweep sweep(1e-3);
  const OrderRange orders = orders_seen(sweep.q, sweep.dq, 0.004, 2.5);
  EXPECT_FALSE(strongest_line(sweep.q, noise(5000, 1), orders, 10));
}

}  // namespace
}  // namespace dyngen::runtime
