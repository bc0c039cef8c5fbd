// SPDX-License-Identifier: MIT
#include "runtime/signals/decimation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

/// rms of what the decimator makes of a sine; frequency in new Nyquist frequencies.
double gain(const Decimator& decimator, double frequency) {
  Eigen::MatrixXd x(40 * decimator.taps.size(), 2);
  for (Eigen::Index k = 0; k < x.rows(); ++k) {
    const double angle = std::numbers::pi * frequency * static_cast<double>(k) /
                         static_cast<double>(decimator.factor);
    x.row(k) << std::sin(angle), std::cos(angle);
  }
  const Eigen::MatrixXd y = decimate(decimator, x);
  return std::sqrt(y.squaredNorm() / static_cast<double>(y.rows()));
}

TEST(Decimation, TorqueStaysTheRegressorTimesTheParameters) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd W = Eigen::MatrixXd::NullaryExpr(3000, 12, [&] { return normal(random); });
  const Eigen::VectorXd beta = Eigen::VectorXd::NullaryExpr(12, [&] { return normal(random); });
  const Decimator decimator = design_decimator(20);
  const Eigen::MatrixXd tau = W * beta;
  const Eigen::MatrixXd filtered = decimate(decimator, tau);
  ASSERT_GT(filtered.rows(), 100);
  EXPECT_LT((filtered - decimate(decimator, W) * beta).norm(), 1e-13 * tau.norm());
}

TEST(Decimation, PassesWhatIsSlowAndStopsWhatWouldFold) {
  for (const Eigen::Index factor : {2, 5, 50}) {
    const Decimator decimator = design_decimator(factor);
    EXPECT_NEAR(decimator.taps.sum(), 1, 1e-14);
    for (const double pass : {0.0, 0.3, 0.6, 0.8}) {
      EXPECT_NEAR(gain(decimator, pass), 1, 2e-3) << factor << " " << pass;
    }
    EXPECT_NEAR(gain(decimator, 0.999), 0.5, 0.02) << factor;
    for (const double stop : {1.2, 1.37, 1.55, 1.9}) {
      EXPECT_LT(gain(decimator, stop), 2e-3)
          << factor << " " << stop;  // 60 dB, and its rounding up
    }
  }
}

TEST(Decimation, MovingAveragesAreShortAndStopWhatFoldsOntoWhatIsSlow) {
  for (const Eigen::Index factor : {3, 6}) {
    const Decimator sharp = design_decimator(factor, {.pass = 0.5});
    const Decimator brief = design_decimator(factor, {.averages = 4});
    EXPECT_EQ(brief.taps.size(), 4 * (factor - 1) + 1);
    EXPECT_LT(brief.taps.size(), 0.5 * static_cast<double>(sharp.taps.size()));
    EXPECT_NEAR(brief.taps.sum(), 1, 1e-14);
    EXPECT_LT((brief.taps - brief.taps.reverse()).norm(), 1e-14);
    // a moving average: sin(pi f / 2) / (factor sin(pi f / 2 / factor)), f in Nyquist frequencies
    for (const double f : {0.1, 0.5, 1.0, 1.7}) {
      const double half = std::numbers::pi * f / 2, size = static_cast<double>(factor);
      EXPECT_NEAR(gain(brief, f), std::pow(std::sin(half) / (size * std::sin(half / size)), 4),
                  1e-3)
          << factor << " " << f;
    }
    // 2 is the new sampling frequency, and folds onto 0
    for (const double f : {1.8, 2.0, 2.2}) EXPECT_LT(gain(brief, f), 5e-4) << factor << " " << f;
  }
}

TEST(Decimation, OutputsStandAtMultiplesOfTheFactorWithAllTapsInside) {
  for (const Eigen::Index factor : {1, 2, 7, 50}) {
    const Decimator decimator = design_decimator(factor);
    const Eigen::Index half = decimator.taps.size() / 2, first = first_sample(decimator);
    EXPECT_EQ(first % factor, 0);
    EXPECT_GE(first, half);
    EXPECT_LT(first - half, factor);
    for (const Eigen::Index N : {first + half, first + half + 1, first + half + 3 * factor}) {
      Eigen::MatrixXd line(N, 1);
      for (Eigen::Index k = 0; k < N; ++k) line(k, 0) = static_cast<double>(k);
      const Eigen::MatrixXd y = decimate(decimator, line);
      ASSERT_EQ(y.rows(), decimated_samples(decimator, N));
      for (Eigen::Index k = 0; k < y.rows(); ++k) {
        EXPECT_NEAR(y(k, 0), static_cast<double>(first + k * factor), 1e-10);
      }
      const Eigen::Index next = first + y.rows() * factor;
      EXPECT_GT(next + half, N - 1);
    }
  }
}

TEST(Decimation, ARunShorterThanTheTapsGivesNothing) {
  EXPECT_EQ(decimate(design_decimator(10), Eigen::MatrixXd::Ones(20, 3)).rows(), 0);
  EXPECT_EQ(decimate(design_decimator(10), Eigen::MatrixXd(0, 3)).rows(), 0);
}

TEST(Decimation, NonsenseIsRefused) {
  EXPECT_THROW(design_decimator(0), std::invalid_argument);
  EXPECT_THROW(design_decimator(5, {.pass = 1.0}), std::invalid_argument);
  for (const int averages : {-2, 3, 10}) {
    EXPECT_THROW(design_decimator(5, {.averages = averages}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace dyngen::runtime
