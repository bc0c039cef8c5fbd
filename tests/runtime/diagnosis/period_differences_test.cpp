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

constexpr Index kOfRun = 1000;
constexpr double kOfPeriod = 200;
constexpr double kLow = 1.0 / kOfRun;  // cycles a sample: a period of the run
constexpr DifferenceLengths kLengths{kOfPeriod, kOfRun};

/// Parts of first order, of memories a factor of 4 apart and equal variance: about 1/f. Sum 1.
const std::array<SlowNoise, 5>& parts() {
  static const auto kParts = [] {
    std::array<SlowNoise, 5> all;
    double memory = 1;
    for (SlowNoise& part : all) {
      part = {std::exp(-1 / memory), std::sqrt(1.0 / static_cast<double>(all.size()))};
      memory *= 4;
    }
    return all;
  }();
  return kParts;
}

double true_density(double frequency) {
  double sum = 0;
  for (const SlowNoise& part : parts()) sum += density(part, frequency);
  return sum;
}

VectorXd noise(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  VectorXd series = VectorXd::Zero(kOfRun);
  for (const SlowNoise& part : parts()) {
    double value = normal(random);
    for (double& x : series) {
      x += part.deviation * value;
      value = part.pole * value + std::sqrt(1 - part.pole * part.pole) * normal(random);
    }
  }
  return series;
}

/// Of three runs that drift as the root of the time since their beginning.
PeriodDifferences differences(const std::array<double, 3>& drifts, std::mt19937_64& random) {
  PeriodDifferences joint;
  for (const double drift : drifts) {
    VectorXd e = noise(random);
    for (Index t = 0; t < kOfRun; ++t) {
      e[t] += drift * std::sqrt(static_cast<double>(t) / kOfRun);
    }
    joint.add(e, VectorXd::Ones(kOfRun), kOfPeriod);
  }
  return joint;
}

TEST(PeriodDifferences, ACommonCourseOfNoiseIsAChiSquare) {
  constexpr int kDraws = 300;
  std::mt19937_64 random(20261126);
  double sum = 0, squares = 0;
  JointNoise known;
  for (const SlowNoise& part : parts()) known.slow.push_back(part);
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto course = differences({0, 0, 0}, random).common_course();
    ASSERT_TRUE(course);
    const double value = chi_square(*course, known);
    sum += value / kDraws;
    squares += value * value / kDraws;
  }
  std::printf("  mean %.2f of 4, variance %.2f of 8\n", sum, squares - sum * sum);
  EXPECT_NEAR(sum, 4, 1.5);  // lines have a width, over which densities are not even
  EXPECT_LT(squares - sum * sum, 12);
}

/// Mean logarithm of the density of the first of two joints at the lowest lines, over the truth.
double lowest(const std::array<double, 3>& drifts) {
  constexpr int kDraws = 20;
  std::mt19937_64 random(20261126);
  double sum = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const std::vector<PeriodDifferences> joints = {differences(drifts, random),
                                                   differences({0, 0, 0}, random)};
    const JointNoise first = noise_of_periods(joints, kLengths)[0];
    sum += std::log(first.density(kLow) / true_density(kLow)) / kDraws;
  }
  return std::exp(sum);
}

TEST(PeriodDifferences, WhatAllRunsShareIsNoNoise) {
  const double none = lowest({0, 0, 0}), shared = lowest({8, 8, 8}), own = lowest({8, -8, 8});
  std::printf(
      "  density over the truth's: no drift %.2f, one in all runs %.2f, signs of their own %.2f\n",
      none, shared, own);
  EXPECT_NEAR(std::log(none), 0, std::log(1.3));
  EXPECT_NEAR(std::log(shared), 0, std::log(1.3));
  EXPECT_GT(own, 1.5 * shared);
}

TEST(PeriodDifferences, ChanceIsHardlyEverTakenOut) {
  constexpr int kDraws = 200;
  std::mt19937_64 random(20261127);
  int taken = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const std::vector<PeriodDifferences> joints = {differences({0, 0, 0}, random),
                                                   differences({0, 0, 0}, random)};
    const std::vector<JointNoise> noise = noise_of_periods(joints, kLengths);
    const std::vector<JointNoise> whole =
        noise_of_differences({joints[0].of_joint(), joints[1].of_joint()}, kLengths);
    taken +=
        noise[0].deviation() != whole[0].deviation() || noise[1].deviation() != whole[1].deviation()
            ? 1
            : 0;
  }
  std::printf("  from %d of %d pairs of joints\n", taken, kDraws);
  EXPECT_LE(taken, 14);
}

TEST(PeriodDifferences, TwoRunsHaveNothingInCommon) {
  std::mt19937_64 random(20261126);
  PeriodDifferences two;
  for (int run = 0; run < 2; ++run) two.add(noise(random), VectorXd::Ones(kOfRun), kOfPeriod);
  EXPECT_FALSE(two.common_course());
}

TEST(PeriodDifferences, AreThoseOfNeighbouringPeriods) {
  std::mt19937_64 random(20261126);
  const VectorXd e = noise(random);
  PeriodDifferences joint;
  joint.add(e, VectorXd::Ones(kOfRun), kOfPeriod);
  const JointDifferences all = joint.of_joint();
  const auto lag = static_cast<Index>(kOfPeriod);
  const VectorXd difference = (e.tail(kOfRun - lag) - e.head(kOfRun - lag)) / M_SQRT2;
  const std::vector<DifferenceLine> by_hand =
      difference_lines(difference, VectorXd::Ones(difference.size()), kOfPeriod, all.process);
  ASSERT_EQ(all.lines.size(), by_hand.size());
  for (std::size_t i = 0; i < by_hand.size(); ++i) {
    EXPECT_NEAR(all.lines[i].power, by_hand[i].power, 1e-9 * by_hand[i].power);
  }
}

TEST(PeriodDifferences, OfARunOfHardlyAPeriodThereAreNone) {
  PeriodDifferences joint;
  std::mt19937_64 random(1);
  const VectorXd e = noise(random);
  joint.add(e.head(250), VectorXd::Ones(250), kOfPeriod);
  EXPECT_EQ(joint.samples(), 0);
  VectorXd counted = VectorXd::Ones(kOfRun);
  counted.segment(100, 50).setZero();
  joint.add(e.cwiseProduct(counted), counted, kOfPeriod);
  EXPECT_EQ(joint.samples(), kOfRun - 200 - 50);
}

}  // namespace
}  // namespace dyngen::runtime
