// SPDX-License-Identifier: MIT
#include "tests/blind/cases/whitening.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kSamples = 1500;

/// One joint that rests twice, its torque noisy: an autoregressive process of order 1.
Recording noisy(double memory, unsigned seed) {
  Recording recording;
  recording.log.rate = 250;
  recording.log.q = recording.log.dq = recording.log.ddq = MatrixXd::Zero(kSamples, 1);
  recording.log.sign = MatrixXd::Ones(kSamples, 1);
  recording.log.sign.middleRows(400, 12).setConstant(0.3);
  recording.log.sign.middleRows(900, 30).setConstant(-0.2);
  recording.log.M.assign(kSamples, MatrixXd::Ones(1, 1));
  recording.encoder_error = MatrixXd::Zero(kSamples, 1);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  recording.torque_noise.resize(kSamples, 1);
  double now = normal(random) / std::sqrt(1 - memory * memory);
  for (Index k = 0; k < kSamples; ++k) {
    recording.torque_noise(k, 0) = now;
    now = memory * now + normal(random);
  }
  return recording;
}

std::vector<Recording> training(double memory) {
  std::vector<Recording> all;
  for (unsigned seed = 1; seed <= 8; ++seed) all.push_back(noisy(memory, seed));
  return all;
}

TEST(RestWhitener, KnowsNothingOfWhatIsThereAtRest) {
  const std::vector<Recording> recordings = training(0.9);
  const Whitener whitener(recordings);
  const RestWhitener white(whitener, recordings[0].log);
  MatrixXd rows = recordings[0].torque_noise;
  const MatrixXd before = white(rows);
  rows.middleRows(900, 30).setConstant(1e3);
  EXPECT_EQ(white(rows), before);
  // nor does it tell from others what would be there
  const VectorXd again = whitener.column(0, before.col(0));
  const double most = whitener.column(0, whitener.column(0, recordings[0].torque_noise.col(0)))
                          .cwiseAbs()
                          .maxCoeff();
  const std::vector<Index> rests = rests_of(recordings[0].log)[0];
  for (const Index k : rests) EXPECT_LT(std::abs(again[k]), 1e-6 * most);
}

TEST(RestWhitener, GapsTellNothingByTheirEdges) {
  // a constant torque in noise with memory: with gaps no more is seen of it than without
  const std::vector<Recording> recordings = training(0.98);
  const Whitener whitener(recordings);
  const RestWhitener white(whitener, recordings[0].log);
  const MatrixXd constant = MatrixXd::Ones(kSamples, 1);
  const double whole = whitener.column(0, constant).squaredNorm();
  EXPECT_LT(white(constant).squaredNorm(), whole * (1 + 1e-9));
  MatrixXd with_edges = constant;
  leave_out_rest(recordings[0].log, with_edges);
  EXPECT_GT(whitener.column(0, with_edges).squaredNorm(), 3 * whole);
}

TEST(RestWhitener, LeavesAsManySquaresAsThereAreKnownSamples) {
  const std::vector<Recording> recordings = training(0.9);
  const Whitener whitener(recordings);
  double sum = 0, known = 0;
  for (const Recording& each : recordings) {
    sum += RestWhitener(whitener, each.log)(each.torque_noise).squaredNorm();
    known += static_cast<double>(kSamples - 42);
  }
  EXPECT_NEAR(sum / known, 1, 0.05);
}

/// A constant torque in noise with memory is told by the density at 0, which one recording hardly
/// knows.
TEST(Whitener, IsOfAllThatNoiseMayBe) {
  constexpr double kMemory = 0.9;
  const DrawNoise draw = [](std::size_t place, std::size_t number, Recording& recording) {
    const auto seed = static_cast<unsigned>(1000 * (place + 1) + number);
    recording.torque_noise = noisy(kMemory, seed).torque_noise;
  };
  const std::vector<Recording> recordings = training(kMemory);
  const VectorXd constant = VectorXd::Ones(kSamples);
  const double expected = kSamples * (1 - kMemory) * (1 - kMemory);
  double worst = 0;
  for (const Recording& each : recordings) {
    EXPECT_NEAR(Whitener({each}, draw).column(0, constant).squaredNorm() / expected, 1, 0.35);
    const double alone = Whitener({each}).column(0, constant).squaredNorm() / expected;
    worst = std::max(worst, std::abs(std::log(alone)));
  }
  EXPECT_GT(worst, std::log(1.5));
  EXPECT_NEAR(Whitener(recordings, draw).column(0, constant).squaredNorm() / expected, 1, 0.12);
}

TEST(Whitener, TakesRecordingsOfDifferentLengths) {
  std::vector<Recording> recordings = training(0.9);
  for (std::size_t i = 1; i < recordings.size(); i += 2) {
    Recording& cut = recordings[i];
    for (MatrixXd* part : {&cut.log.q, &cut.log.dq, &cut.log.ddq, &cut.log.sign, &cut.torque_noise,
                           &cut.encoder_error}) {
      *part = part->topRows(700).eval();
    }
    cut.log.M.resize(700);
  }
  for (const auto& order : {std::pair{0, 1}, {1, 0}}) {  // the longest first, and not
    std::vector<Recording> some = recordings;
    std::swap(some[static_cast<std::size_t>(order.first)], some[0]);
    const Whitener whitener(some);
    for (const Recording& each : some) {
      const VectorXd white = whitener.column(0, each.torque_noise.col(0));
      EXPECT_NEAR(white.squaredNorm() / static_cast<double>(white.size()), 1, 0.2);
    }
  }
}

// Many unknown values are found by conjugate gradients or thinned, few directly: the same is left.
TEST(RestWhitener, LeavesTheSameOfLongRestsByEitherWay) {
  const std::vector<Recording> recordings = training(0.9);
  Log log = recordings[0].log;
  log.sign.middleRows(100, 400).setConstant(0.5);
  MatrixXd rows = recordings[0].torque_noise;
  rows.array() += 3;
  Whitener whitener(recordings);
  for (const bool stopped : {false, true}) {
    if (stopped) whitener.stop_above(20, 250);
    const MatrixXd directly = RestWhitener(whitener, log)(rows);
    const MatrixXd by_steps = RestWhitener(whitener, log, 0, 1)(rows);
    const double tolerance = stopped ? 0.05 : 1e-4;  // near the stop, thinned values tell less
    EXPECT_LT((directly - by_steps).norm(), tolerance * directly.norm()) << stopped;
  }
}

TEST(RestWhitener, StopsWhatIsFaster) {
  const std::vector<Recording> recordings = training(0.5);
  Whitener whitener(recordings);
  const auto sine = [](double hz) {
    MatrixXd values(kSamples, 1);
    for (Index k = 0; k < kSamples; ++k) {
      values(k, 0) = std::sin(2 * M_PI * hz * static_cast<double>(k) / 250);
    }
    return values;
  };
  const double slow = whitener.column(0, sine(10)).norm();
  whitener.stop_above(20, 250);
  EXPECT_NEAR(whitener.column(0, sine(10)).norm(), slow, 1e-6 * slow);
  EXPECT_LT(whitener.column(0, sine(40)).norm(), 1e-6 * slow);
  const RestWhitener white(whitener, recordings[0].log);
  EXPECT_TRUE(white(sine(10)).allFinite());
  EXPECT_LT(white(sine(10)).norm(), slow);
}

TEST(Rests, ReachAroundStandstillAndReversals) {
  Log log = noisy(0, 1).log;
  EXPECT_EQ(rests_of(log)[0].size(), 42U);
  log.sign.bottomRows(300).setConstant(-1);
  EXPECT_EQ(rests_of(log)[0].size(), 42U);  // turning is no rest
  const auto wide = rests_of(log, 0.04)[0];
  EXPECT_EQ(wide.size(), 42U + 4 * 10 + 21);
  EXPECT_TRUE(std::is_sorted(wide.begin(), wide.end()));
  EXPECT_EQ(wide.front(), 390);
}

}  // namespace
}  // namespace blind
