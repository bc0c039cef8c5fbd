// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <utility>

#include "runtime/diagnosis/equation_sets/left_out_rows.h"
#include "runtime/diagnosis/scans/generic_columns.h"
#include "runtime/diagnosis/scans/screening.h"
#include "runtime/effects/absorption.h"
#include "runtime/evidence/evidence_system.h"
#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

EffectRecordings arm_recordings(double seconds, double noise, unsigned seed,
                                const std::vector<EffectInstance>& effects = {}) {
  return effect_recordings(test::planar_arm(), test::planar_arm_tangents(),
                           test::measured({test::sines(seconds, 0.01)}, test::planar_arm_values(),
                                          effects, noise, 0, seed),
                           {1, -1}, {true, true});
}

RunResiduals residuals_at_truth(const EffectRecordings& data) {
  return {residual(data.runs.front().rows, test::planar_arm_values())};
}

TorqueNoiseModel white(double deviation) {
  return {quick_noise(white_noise(VectorXd::Constant(2, deviation)).joints),
          VectorXd::Constant(2, 2000), false, VectorXd::Ones(2)};
}

TEST(TorqueNoiseModel, OfPeriodsDoesNotSeeWhatRepeats) {
  // AR(1) noise of coefficient 0.8 under structure ten times as large, which repeats
  const EffectRecordings data = arm_recordings(60, 0.1, 1);
  const Index rows = data.equations(), period = 1000;
  std::mt19937_64 random(20261121);
  std::normal_distribution<double> normal;
  MatrixXd e(rows, 2);
  for (Index j = 0; j < 2; ++j) {
    double x = normal(random);
    for (Index k = 0; k < rows; ++k) {
      e(k, j) = 0.1 * x + std::sin(2 * M_PI * static_cast<double>(k) / static_cast<double>(period));
      x = 0.8 * x + std::sqrt(1 - 0.64) * normal(random);
    }
  }
  const TorqueNoiseModel repeated =
      torque_noise_model(data, {e}, {static_cast<double>(period)}, false);
  EXPECT_TRUE(repeated.from_periods);
  const TorqueNoiseModel plain = torque_noise_model(data, {e}, {0}, false);
  EXPECT_FALSE(plain.from_periods);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(repeated.joints[j].deviation(), 0.1, 0.01);
    EXPECT_NEAR(repeated.correlation_time[static_cast<Index>(j)], 9, 2.5);
    EXPECT_GT(plain.joints[j].deviation(), 0.5);
  }
}

/// Variances of the noise that is found, mean of some draws: white of variance 1, and on some
/// joints as much of an AR(1) whose memory is three periods.
VectorXd variances_found(const EffectRecordings& data, Index period, bool first, bool second) {
  constexpr int kDraws = 12;
  std::mt19937_64 random(20261121);
  std::normal_distribution<double> normal;
  const double memory = std::exp(-1 / (3 * static_cast<double>(period)));
  VectorXd found = VectorXd::Zero(2);
  for (int draw = 0; draw < kDraws; ++draw) {
    MatrixXd e(data.equations(), 2);
    for (Index j = 0; j < 2; ++j) {
      const bool lasts = j == 0 ? first : second;
      double slow = normal(random);
      for (Index k = 0; k < e.rows(); ++k) {
        e(k, j) = normal(random) + (lasts ? slow : 0);
        slow = memory * slow + std::sqrt(1 - memory * memory) * normal(random);
      }
    }
    const TorqueNoiseModel model =
        torque_noise_model(data, {e}, {static_cast<double>(period)}, false);
    for (std::size_t j = 0; j < 2; ++j) {
      found[static_cast<Index>(j)] += std::pow(model.joints[j].deviation(), 2) / kDraws;
    }
  }
  return found;
}

TEST(TorqueNoiseModel, PutsBackWhatOutlastsAPeriod) {
  const EffectRecordings data = arm_recordings(60, 0.1, 1);
  const Index period = data.equations() / 12;
  const double left = 2 - std::exp(-1.0 / 3);  // of the variance, by differences of neighbours
  const VectorXd both = variances_found(data, period, true, true);
  for (const double variance : both) {
    EXPECT_GT(variance, left + 0.2);
    EXPECT_LT(variance, 2.4);
  }
  // each joint has its own
  const VectorXd one = variances_found(data, period, true, false);
  EXPECT_GT(one[0], left + 0.2);
  EXPECT_LT(one[0], 2.4);
  EXPECT_NEAR(one[1], 1, 0.03);
  const VectorXd none = variances_found(data, period, false, false);
  EXPECT_NEAR(none.mean(), 1, 0.02);
}

/// Density of noise of accelerations of variance 1, and of white noise beside it.
double density_of_accelerations(double white, double frequency) {
  return std::pow(2 - 2 * std::cos(2 * M_PI * frequency), 2) / 6 + white;
}

TEST(TorqueNoiseModel, OfAccelerationsKeepsWhatIsSlow) {
  // joints that rest twenty times a period: a tenth of their equations does not count
  EffectRecordings data = arm_recordings(60, 0.1, 1);
  const Index rows = data.equations(), period = rows / 5;
  for (Index k = 0; k < rows; ++k) {
    if (k % (period / 20) < period / 200) data.runs.front().rows.counted.row(k).setZero();
  }
  constexpr double kWhite = 0.005;
  constexpr int kDraws = 12;
  std::mt19937_64 random(20261125);
  std::normal_distribution<double> normal;
  const std::vector<double> frequencies = {0.002, 0.01, 0.05, 0.2};
  VectorXd found = VectorXd::Zero(4);  // mean logarithms
  double least = 1;
  for (int draw = 0; draw < kDraws; ++draw) {
    MatrixXd e(rows, 2);
    for (Index j = 0; j < 2; ++j) {
      double before = normal(random), now = normal(random);
      for (Index k = 0; k < rows; ++k) {
        const double next = normal(random);
        e(k, j) = (next - 2 * now + before) / std::sqrt(6.0) + std::sqrt(kWhite) * normal(random);
        before = std::exchange(now, next);
      }
    }
    e = e.cwiseProduct(data.runs.front().rows.counted);
    const TorqueNoiseModel model =
        torque_noise_model(data, {e}, {static_cast<double>(period)}, false);
    for (const JointNoise& joint : model.joints) {
      for (std::size_t i = 0; i < frequencies.size(); ++i) {
        const double ratio =
            joint.density(frequencies[i]) / density_of_accelerations(kWhite, frequencies[i]);
        found[static_cast<Index>(i)] += std::log(ratio) / (2 * kDraws);
        least = std::min(least, ratio);
      }
    }
  }
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const double ratio = std::exp(found[static_cast<Index>(i)]);
    std::printf("%.3f cycles for a sample: density over the true one %.2f\n", frequencies[i],
                ratio);
    EXPECT_GT(ratio, 0.8);
    EXPECT_LT(ratio, 1.3);
  }
  // squares of slow structure are at most twice what they are taken for, in any draw
  EXPECT_GT(least, 0.5);
}

TEST(EvidenceSystem, NoiseGivesChiSquare) {
  const EffectRecordings data = arm_recordings(20, 0.1, 2);
  EvidenceSystem::Options options;
  options.surrogates = 400;
  const EvidenceSystem system(data, residuals_at_truth(data), white(0.1), options);
  EffectSignals signals(data);
  signals.set_beta(test::planar_arm_values());
  const GenericStructure structure{0, {{StructureVariable::Kind::kPosition, 1}}};
  const Score score =
      score_of(system.products(system.whitened(generic_columns(data, signals, structure))));
  EXPECT_GE(score.degrees, 5);
  const double mean = score.surrogates.mean();
  EXPECT_NEAR(mean, score.degrees, 4 * std::sqrt(2.0 * score.degrees / 400));
  // and the recording's own noise is one of them
  EXPECT_LT(score.delta_chi2, score.degrees + 5 * std::sqrt(2.0 * score.degrees));
}

TEST(EvidenceSystem, WhatTheModelSpansIsNoEvidence) {
  const EffectRecordings data = arm_recordings(20, 0.1, 3);
  EvidenceSystem system(data, residuals_at_truth(data), white(0.1), {});
  JointColumns offset{{1}, {MatrixXd::Ones(data.equations(), 1)}};
  EXPECT_EQ(score_of(system.products(system.whitened(offset))).degrees, 0);
  // a column that is added is spanned from then on
  JointColumns own{{1}, {data.runs.front().motion.q.col(1)}};
  EXPECT_EQ(score_of(system.products(system.whitened(own))).degrees, 1);
  system.add(system.whitened(own));
  EXPECT_EQ(score_of(system.products(system.whitened(own))).degrees, 0);
}

TEST(EvidenceSystem, SquaresGrowAsTheNoncentralitySays) {
  // a spring of 0.2 N m/rad on joint 2, noise 0.1 N m
  const EffectInstance spring = test::known(test::spring_law(), 1, {0.2});
  const EffectRecordings data = arm_recordings(40, 0.1, 4, {spring});
  const EvidenceSystem system(data, residuals_at_truth(data), white(0.1), {});
  EffectSignals signals(data);
  signals.set_beta(test::planar_arm_values());
  const Products products =
      system.products(system.whitened(effect_columns(data, signals, spring, {1})));
  const double lambda = 0.04 * products.left(0, 0);
  const Score score = score_of(products);
  EXPECT_NEAR(score.delta_chi2, lambda + 1, 4 * std::sqrt(2 + 4 * lambda));
  EXPECT_NEAR(score.coefficients[0], 0.2, 4 * 0.2 / std::sqrt(lambda));
}

/// Of a hundred columns the rows that they have are multiplied, of half as many all rows.
TEST(SideBySide, HasTheJointsOfAll) {
  const MatrixXd a = MatrixXd::Random(4, 2), b = MatrixXd::Random(4, 1), c = MatrixXd::Random(4, 1);
  const JointColumns all = side_by_side({{{0, 2}, {a, 2 * a}}, {}, {{1, 2}, {b, c}}});
  ASSERT_EQ(all.joints, (std::vector<int>{0, 1, 2}));
  MatrixXd first(4, 3), second(4, 3), third(4, 3);
  first << a, MatrixXd::Zero(4, 1);
  second << MatrixXd::Zero(4, 2), b;
  third << 2 * a, c;
  EXPECT_EQ(all.parts[0], first);
  EXPECT_EQ(all.parts[1], second);
  EXPECT_EQ(all.parts[2], third);
  EXPECT_EQ(side_by_side({}).columns(), 0);
}

TEST(EvidenceSystem, ProductsOfColumnsOfAFewRowsAreTheSame) {
  const EffectRecordings data = arm_recordings(20, 0.1, 3);
  const EvidenceSystem system(data, residuals_at_truth(data), white(0.1), {});
  constexpr Index kMany = 100, kHalf = 50;
  JointColumns all{{0, 1}, {}};
  for (int joint = 0; joint < 2; ++joint) {
    MatrixXd columns = MatrixXd::Zero(data.equations(), kMany);
    for (Index c = 0; c < kMany; ++c) {
      for (Index row = 0; row < 12; ++row) {  // neighbours overlap
        columns(15 * c + row + 10 * joint, c) = 1 + 0.1 * static_cast<double>(row * row);
      }
    }
    all.parts.push_back(system.whitened({{joint}, {columns}}).parts[0]);
  }
  const Products together = system.products(all);
  for (const Index first : {Index{0}, kHalf}) {
    const JointColumns half{
        all.joints, {all.parts[0].middleCols(first, kHalf), all.parts[1].middleCols(first, kHalf)}};
    const Products part = system.products(half);
    const auto same = [](const MatrixXd& a, const MatrixXd& b) {
      return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
    };
    EXPECT_LT(same(together.whole.block(first, first, kHalf, kHalf), part.whole), 1e-12);
    EXPECT_LT(same(together.left.block(first, first, kHalf, kHalf), part.left), 1e-12);
    EXPECT_LT(same(together.rest.segment(first, kHalf), part.rest), 1e-12);
    EXPECT_LT(same(together.noise.middleRows(first, kHalf), part.noise), 1e-12);
  }
}

TEST(Surprise, IsTheLogarithmOfTheTailAlsoWhereItIsTooSmallForADouble) {
  EXPECT_NEAR(surprise_of(3.841, 1), -std::log(0.05), 1e-3);
  EXPECT_EQ(surprise_of(0, 3), 0);
  EXPECT_NEAR(surprise_of(1320, 4) - surprise_of(1300, 4), 10, 0.1);
  EXPECT_GT(surprise_of(3000, 2), surprise_of(2000, 2));
  EXPECT_NEAR(surprise_of(3000, 2), 1500, 1e-6);
  // Fisher's F: 5 % of 2 over 20 degrees lie above 3.493; with two degrees the tail is a power
  EXPECT_NEAR(surprise_of(2 * 3.493, 2, 20), -std::log(0.05), 1e-3);
  EXPECT_NEAR(surprise_of(60, 2, 100), 50 * std::log(1.6), 1e-9);
  EXPECT_NEAR(surprise_of(1e6, 2, 200), 100 * std::log(1 + 1e6 / 200), 1e-3);
  EXPECT_NEAR(surprise_of(60, 2, 1e8), surprise_of(60, 2), 1e-3);
}

TEST(Surprise, OfTheThresholdIsAsLikelyAsIsAllowed) {
  Screening screening;
  screening.tests = 5000;
  for (const double allowed : {0.2, 0.01, 1e-4}) {
    EXPECT_NEAR(screening.family_wise(screening.threshold(allowed)), allowed, 1e-9 * allowed);
  }
}

/// A normal deviate beyond the threshold of both tails, and 1.2816 further.
TEST(DetectableLambda, IsFoundNineTimesInTen) {
  EXPECT_NEAR(detectable_lambda(-std::log(0.01 / 200)), std::pow(4.0556 + 1.2816, 2), 0.01);
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise;
  const double surprise = 12, root = std::sqrt(detectable_lambda(surprise));
  constexpr int kCases = 20000;
  int found = 0;
  for (int i = 0; i < kCases; ++i)
    found += surprise_of(std::pow(root + noise(random), 2), 1) > surprise;
  EXPECT_NEAR(found / static_cast<double>(kCases), 0.9, 0.01);
}

TEST(Standstill, IsLeftOutAndReversalsStayIn) {
  EffectRecordings data = arm_recordings(20, 0.1, 5);
  EffectRun& run = data.runs.front();
  const double before = run.rows.counted.sum();
  EffectRun moving = run;
  leave_out_standstill(moving, VectorXd::Constant(2, 0.001));
  EXPECT_EQ(moving.rows.counted.sum(), before);
  run.motion.dq.col(1).segment(500, 300).setZero();
  leave_out_standstill(run, VectorXd::Constant(2, 0.001));
  EXPECT_EQ(run.rows.counted.col(0).sum(), before / 2);
  EXPECT_NEAR(run.rows.counted.col(1).sum(), before / 2 - 300, 4);
  EXPECT_EQ(run.rows.tau(650, 1), 0);
}

TEST(Unvisited, IsLeftOutUnlessTooFewEquationsStay) {
  const EffectRecordings train = arm_recordings(20, 0.1, 5);
  const double all = train.runs.front().rows.counted.col(0).sum();
  EffectRecordings heldout = train;
  leave_out_unvisited(heldout, train);
  EXPECT_EQ(heldout.runs.front().rows.counted.col(0).sum(), all);
  const double beyond = train.runs.front().motion.q.col(0).maxCoeff() + 0.1;
  heldout.runs.front().motion.q.col(0).segment(200, 400).setConstant(beyond);
  leave_out_unvisited(heldout, train);
  EXPECT_NEAR(heldout.runs.front().rows.counted.col(0).sum(), all - 400, 4);
  EXPECT_EQ(heldout.runs.front().rows.counted.col(1).sum(), all);
  EXPECT_EQ(heldout.runs.front().rows.tau(400, 0), 0);
  heldout = train;
  const Index most = train.runs.front().motion.samples() * 4 / 5;
  heldout.runs.front().motion.q.col(0).head(most).setConstant(beyond);
  leave_out_unvisited(heldout, train);
  EXPECT_NEAR(heldout.runs.front().rows.counted.col(0).sum(), all / 5, all / 50);
  heldout = train;
  heldout.runs.front()
      .motion.q.col(0)
      .tail(train.runs.front().motion.samples() - 29)
      .setConstant(beyond);
  leave_out_unvisited(heldout, train);
  EXPECT_EQ(heldout.runs.front().rows.counted.col(0).sum(), all);
}

}  // namespace
}  // namespace dyngen::runtime
