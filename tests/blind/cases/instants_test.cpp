// SPDX-License-Identifier: MIT
#include "tests/blind/cases/instants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kLength = 1000;
constexpr double kRate = 250;

/// One joint that stops between samples 299 and 300, rests at 300 to 309, lets go between 309 and
/// 310, and turns between 699 and 700; in white noise.
Recording with_rest_and_turn() {
  Recording recording;
  Log& log = recording.log;
  log.rate = kRate;
  log.q = log.dq = log.ddq = MatrixXd::Zero(kLength, 1);
  log.sign = MatrixXd::Ones(kLength, 1);
  log.sign.topRows(300).setConstant(-1);
  log.sign.middleRows(300, 10).setConstant(0.2);
  log.sign.bottomRows(kLength - 700).setConstant(-1);
  log.ddq.setConstant(5);
  log.ddq.bottomRows(kLength - 310).setConstant(-5);
  log.dq(299, 0) = -5 * 0.25 / kRate;  // 0 a quarter of a sample later
  log.ddq(310, 0) = 5;
  log.dq(310, 0) = 5 * 0.75 / kRate;  // 0 three quarters before
  log.dq(699, 0) = 0.01;
  log.dq(700, 0) = -0.03;
  log.M.assign(kLength, MatrixXd::Ones(1, 1));
  recording.encoder_error = MatrixXd::Zero(kLength, 1);
  recording.torque_noise.resize(kLength, 1);
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (double& each : recording.torque_noise.reshaped()) each = normal(random);
  return recording;
}

TEST(Instants, LieBetweenSamples) {
  const std::vector<double> instants = instants_of(with_rest_and_turn().log, 0);
  ASSERT_EQ(instants.size(), 13U);  // a stop, ten samples of rest, letting go, a turn
  EXPECT_NEAR(instants[0], 299.25, 1e-9);
  for (std::size_t i = 1; i < 11; ++i) EXPECT_EQ(instants[i], 299 + static_cast<double>(i));
  EXPECT_NEAR(instants[11], 309.25, 1e-9);
  EXPECT_NEAR(instants[12], 699.25, 1e-9);
}

TEST(InstantWhitener, SeesNoImpulseOfATurnAndLittleLessOfTheRest) {
  const std::vector<Recording> recordings = {with_rest_and_turn()};
  const Whitener whitener(recordings);
  const InstantWhitener white(whitener, recordings[0].log);
  const RestWhitener at_rests(whitener, recordings[0].log);
  VectorXd jolt = VectorXd::Zero(kLength);  // about the turn
  jolt[699] = 0.75, jolt[700] = 0.25;
  Whitener slow = whitener;
  slow.stop_above(20, kRate);
  const InstantWhitener slowly(slow, recordings[0].log);
  const RestWhitener slowly_at_rests(slow, recordings[0].log);
  EXPECT_LT(slowly(jolt).squaredNorm(), 0.02 * slowly_at_rests(jolt).squaredNorm());
  VectorXd smooth(kLength);
  for (Index k = 0; k < kLength; ++k) smooth[k] = std::sin(0.05 * static_cast<double>(k));
  EXPECT_LE(white(smooth).squaredNorm(), at_rests(smooth).squaredNorm() * (1 + 1e-9));
  EXPECT_GT(white(smooth).squaredNorm(), 0.95 * at_rests(smooth).squaredNorm());
}

TEST(InstantWhitener, WithoutInstantsIsTheWhitener) {
  std::vector<Recording> recordings = {with_rest_and_turn()};
  recordings[0].log.sign.setOnes();
  const Whitener whitener(recordings);
  const MatrixXd& noise = recordings[0].torque_noise;
  EXPECT_EQ(InstantWhitener(whitener, recordings[0].log)(noise),
            MatrixXd(whitener.column(0, noise.col(0))));
}

}  // namespace
}  // namespace blind
