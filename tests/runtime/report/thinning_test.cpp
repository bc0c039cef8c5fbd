// SPDX-License-Identifier: MIT
#include "runtime/report/thinning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd noise(Index n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  VectorXd values(n);
  for (double& value : values) value = normal(random);
  return values;
}

TEST(ThinnedSignals, KeepEveryPeak) {
  const Index n = 100000;
  const VectorXd x = VectorXd::LinSpaced(n, 0, 100);
  MatrixXd y(n, 2);
  y << 1e-3 * noise(n, 1), 1e-3 * noise(n, 2);
  // single samples that a strided choice would miss
  y(12345, 0) = 7;
  y(12346, 0) = -8;
  y(99999, 1) = 5;
  const ThinnedSignals thin = thinned_signals(x, y, 500);
  ASSERT_EQ(thin.x.size(), 1000);
  EXPECT_EQ(thin.y.col(0).maxCoeff(), 7);
  EXPECT_EQ(thin.y.col(0).minCoeff(), -8);
  EXPECT_EQ(thin.y.col(1).maxCoeff(), 5);
  // in the order of the signal: the peak before the trough
  Index most = 0, least = 0;
  thin.y.col(0).maxCoeff(&most);
  thin.y.col(0).minCoeff(&least);
  EXPECT_LT(most, least);
  for (Index i = 1; i < thin.x.size(); ++i) ASSERT_GT(thin.x[i], thin.x[i - 1]);
  // of each slice by itself
  for (Index slice = 0; slice < 500; ++slice) {
    const auto part = y.col(1).segment(slice * 200, 200);
    EXPECT_EQ(std::min(thin.y(2 * slice, 1), thin.y(2 * slice + 1, 1)), part.minCoeff());
    EXPECT_EQ(std::max(thin.y(2 * slice, 1), thin.y(2 * slice + 1, 1)), part.maxCoeff());
  }
}

TEST(ThinnedSignals, OfFewSamplesAreThose) {
  const VectorXd x = VectorXd::LinSpaced(10, 0, 1);
  const MatrixXd y = noise(10, 3);
  const ThinnedSignals thin = thinned_signals(x, y, 5);
  EXPECT_EQ(thin.x, x);
  EXPECT_EQ(thin.y, y);
}

TEST(ThinnedSignals, PassOverWhatIsNotFinite) {
  const VectorXd x = VectorXd::LinSpaced(100, 0, 1);
  MatrixXd y = MatrixXd::Constant(100, 1, std::numeric_limits<double>::quiet_NaN());
  y(3, 0) = 2;
  const ThinnedSignals thin = thinned_signals(x, y, 10);
  EXPECT_EQ(thin.y(0, 0), 2);
  EXPECT_TRUE(std::isnan(thin.y(2, 0)));
}

TEST(ThinnedSignals, RefuseOtherSizes) {
  EXPECT_THROW(thinned_signals(VectorXd::Zero(3), MatrixXd::Zero(4, 1), 2), std::invalid_argument);
  EXPECT_THROW(thinned_signals(VectorXd::Zero(3), MatrixXd::Zero(3, 1), 0), std::invalid_argument);
}

TEST(Bins, AscendAndHoldEverySample) {
  const VectorXd x = noise(5000, 4);
  const Bins bins = bins_of(x, -0.1, 0.1, 60);
  ASSERT_EQ(bins.of.size(), 5000u);
  EXPECT_LE(bins.x.size(), 60);
  EXPECT_GE(bins.x.size(), 40);
  for (Index b = 1; b < bins.x.size(); ++b) EXPECT_GT(bins.x[b], bins.x[b - 1]);
  for (std::size_t i = 1; i < bins.of.size(); ++i) {
    ASSERT_EQ(
        bins.of[i] > bins.of[i - 1],
        bins.of[i] != bins.of[i - 1] && x[static_cast<Index>(i)] > x[static_cast<Index>(i) - 1]);
  }
}

TEST(Bins, AreNarrowInTheRange) {
  const VectorXd x = VectorXd::LinSpaced(20000, -1, 1);
  const auto inside = [](const Bins& bins) { return (bins.x.array().abs() < 0.05).count(); };
  EXPECT_GE(inside(bins_of(x, -0.05, 0.05, 60)), 20);
  EXPECT_LE(inside(bins_of(x, 0, 0, 60)), 4);
}

TEST(Bins, OfEqualValuesAreOne) {
  VectorXd x(6);
  x << 1, 1, 1, 1, 1, 2;
  const Bins bins = bins_of(x, 0, 0, 6);
  EXPECT_EQ(bins.of[0], bins.of[4]);
  EXPECT_NE(bins.of[0], bins.of[5]);
}

TEST(Binned, AreMeansAndQuartilesOfTheChosen) {
  Bins bins;
  bins.x = Eigen::Vector2d(0, 1);
  bins.of = {0, 0, 0, 0, 0, 1};
  VectorXd y(6);
  y << 1, 2, 3, 4, 5, 6;
  const BinnedValues all = binned(bins, y, {}, 2);
  EXPECT_DOUBLE_EQ(all.mean[0], 3);
  EXPECT_DOUBLE_EQ(all.low[0], 2);
  EXPECT_DOUBLE_EQ(all.high[0], 4);
  EXPECT_TRUE(std::isnan(all.mean[1]));
  const BinnedValues some = binned(bins, y, {true, false, false, false, true, true}, 1);
  EXPECT_DOUBLE_EQ(some.mean[0], 3);
  EXPECT_DOUBLE_EQ(some.low[0], 2);
  EXPECT_DOUBLE_EQ(some.mean[1], 6);
}

TEST(DrawnSamples, AreSpreadAndHoldTheLargest) {
  VectorXd y = noise(50000, 5);
  y[777] = -90;
  y[40000] = 80;
  const std::vector<Index> drawn = drawn_samples(y, 1000);
  EXPECT_TRUE(std::is_sorted(drawn.begin(), drawn.end()));
  EXPECT_GE(drawn.size(), 1000u);
  EXPECT_LE(drawn.size(), 1050u);
  for (const Index place : {777, 40000}) {
    EXPECT_TRUE(std::binary_search(drawn.begin(), drawn.end(), place)) << place;
  }
  // a sample in every hundredth part
  for (Index part = 0; part < 100; ++part) {
    const auto here = std::lower_bound(drawn.begin(), drawn.end(), part * 500);
    EXPECT_TRUE(here != drawn.end() && *here < (part + 1) * 500) << part;
  }
  EXPECT_EQ(drawn_samples(y, 1000), drawn);
  EXPECT_EQ(drawn_samples(VectorXd::Zero(3), 1000).size(), 3u);
}

}  // namespace
}  // namespace dyngen::runtime
