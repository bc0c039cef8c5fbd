// SPDX-License-Identifier: MIT
#include "runtime/ripple/ripple.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <random>
#include <stdexcept>

#include "tests/runtime/ripple/made_ripple.h"

namespace dyngen::runtime {
namespace {

using test::made_ripple;
using test::MadeRipple;
using test::RippleTruth;
using test::Sweep;

/// The line nearest to an order.
const RippleLine* near(const RippleResult& result, double order) {
  const RippleLine* best = nullptr;
  for (const RippleLine& line : result.lines) {
    if (best == nullptr ||
        std::abs(line.order.value - order) < std::abs(best->order.value - order)) {
      best = &line;
    }
  }
  return best;
}

/// Noise as recordings have it: white, coloured, and with structure that the slow model leaves.
MadeRipple surroundings(int kind) {
  MadeRipple made;
  made.memory = kind % 3 == 0 ? 0 : 0.8;
  made.slow = kind % 3 == 2 ? 1 : 0;
  return made;
}

TEST(Ripple, FindsOrdersFrom5To400) {
  constexpr int kRipples = 40;
  std::mt19937 random(101);
  std::uniform_real_distribution<double> part(0, 1);
  int found = 0, within = 0, covered = 0, others = 0;
  for (int i = 0; i < kRipples; ++i) {
    MadeRipple made = surroundings(i);
    made.order = 5 + 395 * part(random);
    made.lambda = 60 * std::pow(10, part(random));
    const RippleTruth truth = made_ripple(made, random);
    const RippleResult result = analyse_ripple(truth.data);
    ASSERT_TRUE(result.judged) << result.why_not;
    const RippleLine* line = near(result, made.order);
    const bool seen =
        line != nullptr && std::abs(line->order.value - made.order) < result.resolution;
    if (!seen) {
      std::cout << "missed: order " << made.order << " of lambda " << made.lambda << "\n";
      continue;
    }
    ++found;
    others += static_cast<int>(result.lines.size()) - 1;
    const double apart = std::abs(line->order.value - made.order);
    within += apart <= 0.005 * made.order ? 1 : 0;
    covered += made.order >= line->order.low && made.order <= line->order.high ? 1 : 0;
    if (apart > 0.005 * made.order) {
      std::cout << "order " << made.order << " of lambda " << made.lambda << " found at "
                << line->order.value << " +- " << line->order.high - line->order.value << "\n";
    }
  }
  std::cout << found << " found, " << within << " within 0.5 %, " << covered
            << " in their interval, " << others << " others\n";
  EXPECT_GE(found, 38);
  EXPECT_EQ(others, 0);
  EXPECT_GE(within, 0.95 * found);
  EXPECT_GE(covered, 0.85 * found);
}

TEST(Ripple, NoiseShowsNoOrder) {
  constexpr int kNulls = 200;
  std::mt19937 random(202);
  int wrong = 0;
  for (int i = 0; i < kNulls; ++i) {
    MadeRipple made = surroundings(i);
    made.seconds = 15;
    const RippleResult result = analyse_ripple(made_ripple(made, random).data);
    ASSERT_TRUE(result.judged) << result.why_not;
    for (const RippleLine& line : result.lines) {
      ++wrong;
      std::cout << "null " << i << ": order " << line.order.value << ", p " << line.chance << "\n";
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST(Ripple, AmplitudeAndPhaseAreInTheirIntervals) {
  constexpr int kRipples = 40;
  std::mt19937 random(303);
  std::uniform_real_distribution<double> part(0, 1);
  int amplitude = 0, phase = 0;
  for (int i = 0; i < kRipples; ++i) {
    MadeRipple made = surroundings(i);
    made.order = 20 + 300 * part(random);
    made.lambda = 400;
    made.phase = made.backward_phase = 6 * part(random) - 3;
    const RippleTruth truth = made_ripple(made, random);
    const RippleLine* line = near(analyse_ripple(truth.data), made.order);
    const RippleResult result = analyse_ripple(truth.data);
    line = near(result, made.order);
    ASSERT_NE(line, nullptr) << made.order;
    const RippleNumber& size = line->both.amplitude;
    amplitude += truth.amplitude >= size.low && truth.amplitude <= size.high ? 1 : 0;
    const double apart = std::remainder(line->both.phase.value - made.phase, 2 * std::numbers::pi);
    phase += std::abs(apart) <= line->both.phase.high - line->both.phase.value ? 1 : 0;
  }
  std::cout << amplitude << " amplitudes and " << phase << " phases of " << kRipples << "\n";
  EXPECT_GE(amplitude, 35);  // 38 are expected, and 5 standard deviations below are 31
  EXPECT_GE(phase, 32);      // the order is estimated too, and moves the phase at q = 0
}

TEST(Ripple, DirectionsHaveAmplitudesOfTheirOwn) {
  std::mt19937 random(404);
  MadeRipple made;
  made.order = 90;
  made.lambda = 900;
  made.backward = 0.3;
  made.backward_phase = 2;
  const RippleTruth truth = made_ripple(made, random);
  const RippleResult result = analyse_ripple(truth.data);
  ASSERT_EQ(result.lines.size(), 1U);
  const RippleLine& line = result.lines.front();
  EXPECT_TRUE(line.differs);
  EXPECT_NEAR(line.forward.amplitude.value / truth.amplitude, 1, 0.15);
  EXPECT_NEAR(line.backward.amplitude.value / truth.amplitude, 0.3, 0.15);
}

TEST(Ripple, OneDirectionAloneIsEnough) {
  std::mt19937 random(505);
  MadeRipple made;
  made.order = 120;
  made.lambda = 300;
  RippleTruth truth = made_ripple(made, random);
  truth.data.q = Eigen::VectorXd::LinSpaced(truth.data.q.size(), 0, 15);
  truth.data.q.array() += 0.5 * (0.9 * truth.data.q.array()).sin();
  const double step = truth.data.sample_time;
  for (Eigen::Index k = 1; k < truth.data.q.size(); ++k) {
    truth.data.dq[k] = (truth.data.q[k] - truth.data.q[k - 1]) / step;
  }
  truth.data.dq[0] = truth.data.dq[1];
  std::normal_distribution<double> normal(0, 0.1);
  for (Eigen::Index k = 0; k < truth.data.q.size(); ++k) {
    truth.data.residual[k] = 0.02 * std::cos(120 * truth.data.q[k]) + normal(random);
  }
  const RippleResult result = analyse_ripple(truth.data);
  ASSERT_EQ(result.lines.size(), 1U);
  EXPECT_NEAR(result.lines.front().order.value, 120, 0.1);
  EXPECT_TRUE(result.lines.front().forward.known);
  EXPECT_FALSE(result.lines.front().backward.known);
}

TEST(Ripple, SeveralOrdersAreFoundTogether) {
  std::mt19937 random(606);
  MadeRipple made;
  made.order = 48;
  made.lambda = 3000;
  RippleTruth truth = made_ripple(made, random);
  for (Eigen::Index k = 0; k < truth.data.q.size(); ++k) {
    truth.data.residual[k] += 0.4 * truth.amplitude * std::cos(200 * truth.data.q[k]);
  }
  const RippleResult result = analyse_ripple(truth.data);
  ASSERT_EQ(result.lines.size(), 2U);
  EXPECT_NEAR(result.lines[0].order.value, 48, 0.1);
  EXPECT_NEAR(result.lines[1].order.value, 200, 0.1);
}

TEST(Ripple, AResonanceIsNoRipple) {
  std::mt19937 random(707);
  int wrong = 0;
  for (const Sweep sweep : {Sweep::kSines, Sweep::kSpeeds}) {
    for (int i = 0; i < 10; ++i) {
      MadeRipple made = surroundings(i);
      made.sweep = sweep;
      made.resonance_hz = 12 + 3 * i;
      made.resonance = 0.2;
      const RippleResult result = analyse_ripple(made_ripple(made, random).data);
      ASSERT_TRUE(result.judged);
      wrong += static_cast<int>(result.lines.size());
      for (const RippleLine& line : result.lines) {
        std::cout << made.resonance_hz << " Hz as order " << line.order.value << "\n";
      }
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST(Ripple, ALineOfTheMainsIsNoRipple) {
  std::mt19937 random(808);
  int wrong = 0, named = 0;
  for (const Sweep sweep : {Sweep::kSines, Sweep::kSpeeds}) {
    for (const double hz : {20.0, 50.0, 100.0}) {
      MadeRipple made;
      made.sweep = sweep;
      made.line_hz = hz;
      made.line = 0.05;
      const RippleResult result = analyse_ripple(made_ripple(made, random).data);
      ASSERT_TRUE(result.judged);
      wrong += static_cast<int>(result.lines.size());
      for (const RippleLine& line : result.lines) {
        std::cout << hz << " Hz as order " << line.order.value << "\n";
      }
      for (const RippleLine& line : result.ruled_out) {
        named += line.kind == RippleKind::kFrequency && std::abs(line.rival - hz) < 1 ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(named, 0);
}

TEST(Ripple, APositionErrorGrowsWithTheSpeed) {
  std::mt19937 random(909);
  int position = 0, torque = 0;
  for (int i = 0; i < 10; ++i) {
    MadeRipple made = surroundings(i);
    made.order = 60 + 20 * i;
    made.lambda = 600;
    for (const bool error : {true, false}) {
      made.position_error = error;
      const RippleResult result = analyse_ripple(made_ripple(made, random).data);
      const RippleLine* line = near(result, made.order);
      if (line == nullptr) continue;
      if (error) position += line->kind == RippleKind::kPosition ? 1 : 0;
      if (!error) torque += line->kind == RippleKind::kTorque ? 1 : 0;
    }
  }
  std::cout << position << " position errors and " << torque << " torques of 10 each\n";
  EXPECT_GE(position, 9);
  EXPECT_EQ(torque, 10);
}

TEST(Ripple, AtOneSpeedAnOrderAboveNyquistIsNotCalledARipple) {
  std::mt19937 random(1010);
  MadeRipple made;
  made.sweep = Sweep::kSpeeds;
  made.rate = 250;
  made.seconds = 40;
  made.reach = 60;                                     // turns: nearly all samples at 1.3 rad/s
  made.order = 2 * std::numbers::pi * 250 / 1.3 - 80;  // 1128: 233 Hz, seen at 17 Hz
  made.lambda = 500;
  const RippleResult result = analyse_ripple(made_ripple(made, random).data);
  ASSERT_TRUE(result.judged);
  for (const RippleLine& line : result.lines) {
    ADD_FAILURE() << "order " << line.order.value;
  }
  ASSERT_FALSE(result.ruled_out.empty());
  EXPECT_NE(result.ruled_out.front().kind, RippleKind::kTorque);
}

TEST(Ripple, StatedOrdersAreTestedFirst) {
  std::mt19937 random(1111);
  MadeRipple made;
  made.order = 202;
  made.lambda = 30;  // too weak among all orders
  const RippleTruth truth = made_ripple(made, random);
  RippleData told = truth.data;
  told.gear_ratio = 101;
  told.stated = {101, 202, 404};
  const RippleResult with = analyse_ripple(told);
  ASSERT_EQ(with.lines.size(), 1U);
  EXPECT_EQ(with.lines.front().stated, 202);
  EXPECT_NEAR(with.lines.front().of_motor, 2, 0.01);
  EXPECT_LT(with.lines.front().chance, RippleRules().chance);
}

TEST(Ripple, WhatIsBelowTheLimitIsRarelyThere) {
  std::mt19937 random(1212);
  const RippleResult null = analyse_ripple(made_ripple(MadeRipple(), random).data);
  ASSERT_TRUE(null.judged);
  ASSERT_GT(null.below, 0);
  int found = 0;
  for (int i = 0; i < 10; ++i) {
    RippleTruth truth = made_ripple(MadeRipple(), random);
    for (Eigen::Index k = 0; k < truth.data.q.size(); ++k) {
      truth.data.residual[k] += null.below * std::cos((50 + 20 * i) * truth.data.q[k]);
    }
    found += analyse_ripple(truth.data).lines.empty() ? 0 : 1;
  }
  EXPECT_GE(found, 8);  // 9.5 are expected
}

TEST(Ripple, AJointThatStandsIsNotJudged) {
  RippleData data;
  data.sample_time = 1e-3;
  data.q = data.dq = data.ddq = data.residual = Eigen::VectorXd::Zero(5000);
  const RippleResult result = analyse_ripple(data);
  EXPECT_FALSE(result.judged);
  EXPECT_FALSE(result.why_not.empty());
}

TEST(Ripple, AJointWithoutTorqueIsNotJudged) {
  std::mt19937 random(1313);
  RippleData data = made_ripple(MadeRipple(), random).data;
  data.residual.setConstant(std::nan(""));
  EXPECT_FALSE(analyse_ripple(data).judged);
}

TEST(Ripple, SizesThatDifferAreRefused) {
  RippleData data;
  data.sample_time = 1e-3;
  data.q = Eigen::VectorXd::Zero(10);
  EXPECT_THROW(analyse_ripple(data), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
