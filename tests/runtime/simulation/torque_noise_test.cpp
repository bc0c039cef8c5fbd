// SPDX-License-Identifier: MIT
#include "runtime/simulation/torque_noise.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::Index;

Eigen::MatrixXd samples_of(const TorqueNoiseOptions& options, Index count, unsigned seed) {
  TorqueNoise noise(options, 2, seed);
  Eigen::MatrixXd samples(count, 2);
  for (Index k = 0; k < count; ++k) samples.row(k) = noise.next();
  return samples;
}

TEST(TorqueNoise, HasTheVarianceAndCorrelationAskedFor) {
  const TorqueNoiseOptions options{Eigen::Vector2d(2, 0.5), 0.4, 0.8};
  const Index count = 200000;
  const Eigen::MatrixXd x = samples_of(options, count, 1);
  for (int j = 0; j < 2; ++j) {
    const double variance = options.deviation[j] * options.deviation[j];
    // an AR(1) process of pole 0.8 has about a ninth of the independent samples
    EXPECT_NEAR(x.col(j).squaredNorm() / static_cast<double>(count), variance, 0.03 * variance);
    for (const Index lag : {1, 3}) {
      const double correlation = x.col(j).head(count - lag).dot(x.col(j).tail(count - lag)) /
                                 static_cast<double>(count - lag) / variance;
      EXPECT_NEAR(correlation, 0.4 * std::pow(0.8, lag), 0.02);
    }
  }
  EXPECT_NEAR(x.col(0).dot(x.col(1)) / static_cast<double>(count), 0, 0.02);
}

TEST(TorqueNoise, RepeatsWithItsSeed) {
  const TorqueNoiseOptions options{Eigen::Vector2d(1, 1), 0.5, 0.9};
  EXPECT_EQ(samples_of(options, 10, 7), samples_of(options, 10, 7));
  EXPECT_NE(samples_of(options, 10, 7), samples_of(options, 10, 8));
  EXPECT_TRUE(samples_of({}, 10, 7).isZero(0));
}

TEST(TorqueNoise, RefusesWrongOptions) {
  EXPECT_THROW(TorqueNoise({Eigen::Vector3d::Ones()}, 2, 1), std::invalid_argument);
  EXPECT_THROW(TorqueNoise({{}, 1.5, 0.5}, 2, 1), std::invalid_argument);
  EXPECT_THROW(TorqueNoise({{}, 0.5, 1}, 2, 1), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
