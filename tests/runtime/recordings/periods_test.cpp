// SPDX-License-Identifier: MIT
#include "runtime/recordings/periods.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace dyngen::test {
namespace {

using runtime::Periods;
using runtime::Recording;

/// Two joints that move with five harmonics of 1 / period, encoders of 2^-16 turns, torque noise
/// 0.5 and 0.1 N m.
Recording periodic(double period, double step, Eigen::Index samples, double tail = 0) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  Recording recording;
  recording.run_starts = {0};
  recording.time.resize(samples);
  recording.q.resize(samples, 2);
  recording.tau.resize(samples, 2);
  const double count = 2 * M_PI / 65536;
  for (Eigen::Index k = 0; k < samples; ++k) {
    const double t = static_cast<double>(k) * step;
    const double w = 2 * M_PI / period;
    recording.time(k) = t;
    double q1 = 0, q2 = 0;
    for (int h = 1; h <= 5; ++h) {
      q1 += std::sin(h * w * t + h) / (h * h);
      q2 += 0.3 * std::cos(h * w * t - 2 * h) / h;
    }
    q1 += tail * t;
    recording.q(k, 0) = std::round(q1 / count) * count;
    recording.q(k, 1) = std::round(q2 / count) * count;
    recording.tau(k, 0) = 20 * q1 + 0.5 * normal(generator);
    recording.tau(k, 1) = 5 * q2 + 0.1 * normal(generator);
  }
  return recording;
}

TEST(Periods, FindsAWholeNumberOfSamples) {
  const Recording recording = periodic(2.0, 0.002, 10300);
  const Periods found = runtime::find_periods(recording);
  EXPECT_EQ(found.samples, 1000) << found.message;
  EXPECT_DOUBLE_EQ(found.period, 2.0);
  EXPECT_EQ(found.count, 10);
  EXPECT_GT(found.correlation, 0.99999);
}

TEST(Periods, FindsAPeriodBetweenSamples) {
  for (const double period : {1.2345, 0.98765, 3.00031}) {
    const Periods found = runtime::find_periods(periodic(period, 0.002, 9000));
    EXPECT_EQ(found.samples, std::lround(period / 0.002)) << found.message;
    EXPECT_NEAR(found.period, period, 0.01 * 0.002);  // a hundredth of a sample
    EXPECT_EQ(found.count, static_cast<int>(18 / period));
  }
}

TEST(Periods, FindsExactlyTwo) {
  const Periods found = runtime::find_periods(periodic(2.0, 0.002, 2000));
  EXPECT_EQ(found.samples, 1000) << found.message;
  EXPECT_EQ(found.count, 2);
  EXPECT_EQ(runtime::find_periods(periodic(2.0, 0.002, 1900)).samples, 0);
}

TEST(Periods, SeesALongRunThinnedOut) {
  const Periods found = runtime::find_periods(periodic(10.0, 0.0002, 300000));
  EXPECT_EQ(found.samples, 50000) << found.message;
  EXPECT_EQ(found.count, 6);
}

TEST(Periods, DoesNotTakeAPartThatNearlyRepeats) {
  Recording recording = periodic(1.0, 0.002, 8000);
  recording.q.col(0).array() += 0.02 * (M_PI * recording.time.array()).sin();  // 2 s
  EXPECT_EQ(runtime::find_periods(recording).samples, 1000);
}

TEST(Periods, WantsEveryMovingJointToRepeat) {
  Recording recording = periodic(1.0, 0.002, 8000);
  recording.q.col(1) = 0.5 * (2.7 * recording.time.array().square()).sin();
  EXPECT_EQ(runtime::find_periods(recording).samples, 0);
  recording.q.col(1).setConstant(0.3);
  EXPECT_EQ(runtime::find_periods(recording).samples, 500);
}

/// Friction holds it somewhere within what its controller lets pass, each time somewhere else.
TEST(Periods, AJointThatIsHeldNeedNotRepeat) {
  Recording recording = periodic(1.0, 0.002, 8000);
  const auto held = [&](double part) {
    recording.q.col(1) =
        0.3 + part * std::sqrt(2.0) * (2.7 * recording.time.array().square()).sin();
    return runtime::find_periods(recording).samples;
  };
  const double largest =
      runtime::column_rms(recording.q.rowwise() - recording.q.colwise().mean())[0];
  EXPECT_EQ(held(0.005 * largest), 500);
  EXPECT_EQ(held(0.02 * largest), 0);
}

TEST(Periods, FindsThePeriodOfANoisyJoint) {
  Recording recording = periodic(1.0, 0.002, 8000);
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  for (double& q : recording.q.col(1)) q += 0.02 * normal(generator);  // of about 0.3
  EXPECT_EQ(runtime::find_periods(recording).samples, 500);
  recording.q.col(0).array() += 0.1 * recording.time.array();  // noise excuses no other joint
  EXPECT_EQ(runtime::find_periods(recording).samples, 0);
}

TEST(Periods, FindsNoneWhereThereIsNone) {
  EXPECT_EQ(runtime::find_periods(periodic(2.0, 0.002, 8000, 0.1)).samples, 0);
  Recording recording = periodic(2.0, 0.002, 8000);
  recording.q.col(0) = (2 * recording.time.array()).sin() + (2.9 * recording.time.array()).sin();
  const Periods none = runtime::find_periods(recording);
  EXPECT_EQ(none.samples, 0);
  EXPECT_EQ(none.message, "the motion does not repeat");
  recording.q.setConstant(1);
  EXPECT_EQ(runtime::find_periods(recording).message, "no joint moves, so there is no period");
}

TEST(Periods, ChecksAGivenPeriod) {
  const Recording recording = periodic(2.0, 0.002, 10300);
  const Periods right = runtime::find_periods(recording, 2.0);
  EXPECT_EQ(right.samples, 1000);
  EXPECT_EQ(right.message, "10 periods of 2 s (1000 samples), correlation 1.000000");
  EXPECT_NE(runtime::find_periods(recording, 1.7).message.find("repeat badly"), std::string::npos);
  EXPECT_EQ(runtime::find_periods(recording, 100.0).samples, 0);
  EXPECT_THROW(runtime::find_periods(recording, -1.0), std::invalid_argument);
}

TEST(Periods, TheirMeanAndScatterAreThoseOfSignalAndNoise) {
  for (const double period : {2.0, 1.99871}) {
    const Recording recording = periodic(period, 0.002, 16300);
    const Periods found = runtime::find_periods(recording);
    ASSERT_EQ(found.count, 16) << found.message;
    const Recording mean = runtime::average_periods(recording, found);
    ASSERT_EQ(mean.samples(), found.samples);
    EXPECT_EQ(mean.run_starts, std::vector<Eigen::Index>{0});
    // 20 q1 and 5 q2 were the torques without noise: what is left is noise / sqrt(16)
    const Eigen::RowVectorXd left = runtime::column_rms(
        mean.tau - mean.q * Eigen::Vector2d(20, 5).asDiagonal().toDenseMatrix());
    EXPECT_NEAR(left(0), 0.5 / 4, 0.02);
    EXPECT_NEAR(left(1), 0.1 / 4, 0.004);
    const Eigen::MatrixXd scatter = runtime::period_scatter(recording, found);
    ASSERT_EQ(scatter.rows(), found.samples);
    const Eigen::RowVectorXd noise = runtime::column_rms(scatter);
    // a spline changes the noise between samples by some per cent
    EXPECT_NEAR(noise(0), 0.5, period == 2.0 ? 0.01 : 0.06);
    EXPECT_NEAR(noise(1), 0.1, period == 2.0 ? 0.002 : 0.012);
  }
}

TEST(Periods, OfTheLongestRun) {
  Recording recording = periodic(2.0, 0.002, 8000);
  recording.run_starts = {0, 1500};
  const Periods found = runtime::find_periods(recording);
  EXPECT_EQ(found.first, 1500);
  EXPECT_EQ(found.count, 6);
  EXPECT_EQ(runtime::average_periods(recording, found).time(0), recording.time(1500));
}

TEST(Periods, OfNoneNoMeanIsTaken) {
  EXPECT_THROW(runtime::average_periods(periodic(2.0, 0.002, 2000), Periods()),
               std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::test
