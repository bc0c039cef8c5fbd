// SPDX-License-Identifier: MIT
#include "runtime/evidence/period_differences.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kSamples = 2000;
constexpr double kPeriod = 400;
constexpr double kLow = 2.0 / kSamples;  // cycles a sample: below two periods of the run

/// First order noise of a memory of 20 samples and of variance 1.
VectorXd noise(Index samples, std::mt19937_64& random) {
  constexpr double kPole = 0.95;
  std::normal_distribution<double> normal;
  VectorXd series(samples);
  double value = normal(random);
  for (double& x : series) {
    x = value;
    value = kPole * value + std::sqrt(1 - kPole * kPole) * normal(random);
  }
  return series;
}

/// A drift as the root of time since the beginning, of a size for each run.
JointDifferences differences(const std::array<double, 3>& drifts, std::mt19937_64& random) {
  PeriodDifferences joint;
  for (const double drift : drifts) {
    VectorXd e = noise(kSamples, random);
    for (Index t = 0; t < kSamples; ++t) {
      e[t] += drift * std::sqrt(static_cast<double>(t) / kSamples);
    }
    joint.add(e, VectorXd::Ones(kSamples), kPeriod);
  }
  return joint.of_joint();
}

/// Power of the lowest lines over what the noise has there.
double lowest_power(const std::array<double, 3>& drifts) {
  constexpr int kDraws = 200;
  std::mt19937_64 random(20261126);
  double sum = 0, count = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    for (const DifferenceLine& line : differences(drifts, random).lines) {
      if (line.frequency > kLow) continue;
      sum += line.power / (line.passed * density(SlowNoise{0.95, 1}, line.frequency));
      count += 1;
    }
  }
  return sum / count;
}

TEST(PeriodDifferences, NoiseKeepsItsLowLines) {
  std::printf("  lowest lines over the noise's: %.3f\n", lowest_power({0, 0, 0}));
  EXPECT_NEAR(lowest_power({0, 0, 0}), 1, 0.2);
}

TEST(PeriodDifferences, WhatAllRunsShareIsNoNoise) {
  const double shared = lowest_power({12, 12, 12}), own = lowest_power({12, -12, 12});
  std::printf("  with one drift in all runs %.3f, with a sign of its own in each %.3f\n", shared,
              own);
  EXPECT_NEAR(shared, 1, 0.2);
  EXPECT_GT(own, 3);
}

/// Three runs of noise have hardly ever a course in common.
TEST(PeriodDifferences, ChanceIsHardlyEverTakenOut) {
  constexpr int kDraws = 2000;
  std::mt19937_64 random(20261127);
  int taken = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    PeriodDifferences joint;
    for (int run = 0; run < 3; ++run) {
      joint.add(noise(kSamples / 4, random), VectorXd::Ones(kSamples / 4), kPeriod / 4);
    }
    taken += joint.shared() > 14 ? 1 : 0;
  }
  std::printf("  %d of %d\n", taken, kDraws);
  EXPECT_LE(taken, 8);
}

TEST(PeriodDifferences, TwoRunsHaveNothingInCommon) {
  std::mt19937_64 random(20261126);
  const VectorXd first = noise(kSamples, random), second = noise(kSamples, random);
  PeriodDifferences two, one;
  for (const VectorXd& e : {first, second}) two.add(e, VectorXd::Ones(kSamples), kPeriod);
  one.add(first, VectorXd::Ones(kSamples), kPeriod);
  const JointDifferences both = two.of_joint(), alone = one.of_joint();
  ASSERT_EQ(both.lines.size(), 2 * alone.lines.size());
  const Index lag = static_cast<Index>(kPeriod);
  const VectorXd difference = (first.tail(kSamples - lag) - first.head(kSamples - lag)) / M_SQRT2;
  const std::vector<DifferenceLine> by_hand =
      difference_lines(difference, VectorXd::Ones(difference.size()), kPeriod, alone.process);
  for (std::size_t i = 0; i < by_hand.size(); ++i) {
    EXPECT_NEAR(alone.lines[i].power, by_hand[i].power, 1e-9 * by_hand[i].power);
  }
}

TEST(PeriodDifferences, ARunOfHardlyAPeriodHasNone) {
  PeriodDifferences joint;
  std::mt19937_64 random(1);
  joint.add(noise(500, random), VectorXd::Ones(500), kPeriod);
  EXPECT_EQ(joint.samples(), 0);
  VectorXd counted = VectorXd::Ones(1000);
  counted.segment(100, 50).setZero();
  joint.add(noise(1000, random).cwiseProduct(counted), counted, kPeriod);
  EXPECT_EQ(joint.samples(), 1000 - 400 - 50);
}

}  // namespace
}  // namespace dyngen::runtime
