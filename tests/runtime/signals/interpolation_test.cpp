// SPDX-License-Identifier: MIT
#include "runtime/signals/interpolation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(Interpolation, AShiftIsExactOnASine) {
  VectorXd x(400), expected(400);
  for (Index k = 0; k < 400; ++k) {
    x[k] = std::sin(0.3 * static_cast<double>(k));
    expected[k] = std::sin(0.3 * (static_cast<double>(k) + 2.37));
  }
  const VectorXd found = shifted(x, 2.37);
  EXPECT_LT((found - expected).segment(20, 360).cwiseAbs().maxCoeff(), 1e-4);
}

/// A sine of each frequency, in parts of the sampling frequency.
MatrixXd sines(Index samples, const std::vector<double>& frequencies) {
  MatrixXd x(samples, static_cast<Index>(frequencies.size()));
  for (Index j = 0; j < x.cols(); ++j) {
    const double angle = 2 * std::numbers::pi * frequencies[static_cast<std::size_t>(j)];
    for (Index k = 0; k < samples; ++k) x(k, j) = std::sin(angle * static_cast<double>(k) + 0.3);
  }
  return x;
}

TEST(Interpolation, OfEveryOtherSampleIsTheSameUpToAFifthOfTheirFrequency) {
  const MatrixXd x = sines(501, {0.004, 0.05, 0.1, 0.2});
  for (const int parity : {0, 1}) {
    const MatrixXd half = of_every_other(x, parity);
    const VectorXd inner = (half - x).middleRows(40, 420).cwiseAbs().colwise().maxCoeff();
    EXPECT_LT(inner[0], 1e-4) << parity;
    EXPECT_LT(inner[1], 3e-4) << parity;
    EXPECT_LT(inner[2], 1e-3) << parity;
    EXPECT_LT(inner[3], 0.02) << parity;
    // what is slow is near the ends, too
    EXPECT_LT((half - x).col(0).cwiseAbs().maxCoeff(), 1e-3) << parity;
    for (Index k = parity; k < x.rows(); k += 2) EXPECT_EQ(half.row(k), x.row(k)) << k;
  }
}

TEST(Interpolation, OfEveryOtherSampleHasNoneOfTheOthersNoise) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  MatrixXd noise(4000, 1);
  for (double& value : noise.reshaped()) value = normal(random);
  const VectorXd even = of_every_other(noise, 0), odd = of_every_other(noise, 1);
  MatrixXd changed = noise;
  for (Index k = 1; k + 1 < noise.rows(); k += 2) changed(k, 0) = 100;
  EXPECT_EQ(VectorXd(of_every_other(changed, 0)).head(3998), even.head(3998));
  // white noise of independent samples: products vanish in the mean
  EXPECT_LT(std::abs(even.dot(odd)), 0.05 * even.norm() * odd.norm());
}

TEST(Interpolation, OfFewSamplesIsDefined) {
  for (const Index samples : {1, 2, 3, 5}) {
    const MatrixXd x = sines(samples, {0.01});
    for (const int parity : {0, 1}) {
      const MatrixXd half = of_every_other(x, parity);
      EXPECT_LT((half - x).cwiseAbs().maxCoeff(), 0.01) << samples << " " << parity;
    }
  }
}

}  // namespace
}  // namespace dyngen::runtime
