// SPDX-License-Identifier: MIT
#include "runtime/recordings/quantisation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dyngen::test {
namespace {

using runtime::Quantisation;

Eigen::VectorXd sine(Eigen::Index samples, double radians_per_sample) {
  return (Eigen::VectorXd::LinSpaced(samples, 0, static_cast<double>(samples - 1)) *
          radians_per_sample)
      .array()
      .sin();
}

Eigen::VectorXd stepped(const Eigen::VectorXd& signal, double step) {
  return (signal / step).array().round() * step;
}

TEST(Quantisation, FindsTheEncoderStep) {
  for (const double step : {2 * M_PI / 4096, 2 * M_PI / 65536, 2 * M_PI / 1048576}) {
    const Quantisation found = runtime::find_quantisation(stepped(sine(5000, 0.003), step));
    EXPECT_NEAR(found.step, step, 1e-6 * step);
    EXPECT_GT(found.fraction, 0.999);
    EXPECT_FALSE(found.print_resolution);
  }
}

TEST(Quantisation, FindsTheStepThroughRoundingOfPrint) {
  const double step = 2 * M_PI / 65536;
  const Quantisation found =
      runtime::find_quantisation(stepped(stepped(sine(5000, 0.003), step), 1e-6));
  EXPECT_NEAR(found.step, step, 1e-3 * step);
  EXPECT_FALSE(found.print_resolution);
}

TEST(Quantisation, FindsTheStepOfNoisyTorque) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  Eigen::VectorXd torque = 30 * sine(3000, 0.01);
  for (double& value : torque) value += 0.4 * normal(generator);
  const double step = 400.0 / 4096;
  torque = stepped(torque, step);
  torque(77) += 0.3 * step;  // an outlier
  EXPECT_NEAR(runtime::find_quantisation(torque).step, step, 1e-4 * step);
}

TEST(Quantisation, FlagsMereDecimals) {
  const Quantisation found = runtime::find_quantisation(stepped(sine(5000, 0.003), 1e-4));
  EXPECT_NEAR(found.step, 1e-4, 1e-8);
  EXPECT_TRUE(found.print_resolution);
}

TEST(Quantisation, FindsNoneInSmoothOrNoisySignals) {
  EXPECT_EQ(runtime::find_quantisation(sine(5000, 0.003)).step, 0);
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  Eigen::VectorXd noise(5000);
  for (double& value : noise) value = normal(generator);
  EXPECT_EQ(runtime::find_quantisation(noise).step, 0);
  EXPECT_EQ(runtime::find_quantisation(Eigen::VectorXd::Constant(1000, 3)).step, 0);
  EXPECT_EQ(runtime::find_quantisation(Eigen::VectorXd()).step, 0);
}

}  // namespace
}  // namespace dyngen::test
