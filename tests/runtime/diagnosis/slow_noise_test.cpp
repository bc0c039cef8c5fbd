// SPDX-License-Identifier: MIT
#include "runtime/evidence/slow_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kSlowSamples = 2000, kSlowPeriods = 5, kRuns = 3, kLags = 41;
constexpr double kSlowPeriod = double{kSlowSamples} / kSlowPeriods;

using Series = std::function<VectorXd(std::mt19937_64&)>;

/// First order noise of variance 1.
void add_first_order(double pole, double deviation, std::mt19937_64& random, VectorXd& series) {
  std::normal_distribution<double> normal;
  double value = normal(random);
  for (double& x : series) {
    x += deviation * value;
    value = pole * value + std::sqrt(1 - pole * pole) * normal(random);
  }
}

/// 1/f noise of variance 1: memories double from one process to the next, up to ten periods.
constexpr int kProcesses = 13;
VectorXd pink(std::mt19937_64& random) {
  VectorXd series = VectorXd::Zero(kSlowSamples);
  for (int k = 0; k < kProcesses; ++k) {
    add_first_order(std::exp(-1 / std::exp2(k)), std::sqrt(1.0 / kProcesses), random, series);
  }
  return series;
}

double pink_density(double frequency) {
  double sum = 0;
  for (int k = 0; k < kProcesses; ++k) {
    sum += density(SlowNoise{std::exp(-1 / std::exp2(k)), std::sqrt(1.0 / kProcesses)}, frequency);
  }
  return sum;
}

VectorXd first_order(std::mt19937_64& random) {
  VectorXd series = VectorXd::Zero(kSlowSamples);
  add_first_order(0.95, 1, random, series);
  return series;
}

JointDifferences differences(const Series& series, std::mt19937_64& random) {
  JointDifferences joint;
  joint.covariance = VectorXd::Zero(kLags);
  const auto period = static_cast<Index>(kSlowPeriod);
  std::vector<VectorXd> runs;
  for (int run = 0; run < kRuns; ++run) {
    const VectorXd e = series(random);
    runs.emplace_back((e.tail(kSlowSamples - period) - e.head(kSlowSamples - period)) /
                      std::sqrt(2.0));
    const VectorXd& d = runs.back();
    for (Index lag = 0; lag < kLags; ++lag) {
      const Index pairs = d.size() - lag;
      joint.covariance[lag] +=
          d.tail(pairs).dot(d.head(pairs)) / static_cast<double>(pairs * kRuns);
    }
    joint.samples += static_cast<double>(d.size());
  }
  joint.process = fit_autoregression(joint.covariance, joint.samples);
  for (const VectorXd& d : runs) {
    const auto lines = difference_lines(d, VectorXd::Ones(d.size()), kSlowPeriod, joint.process);
    joint.lines.insert(joint.lines.end(), lines.begin(), lines.end());
  }
  return joint;
}

TEST(SlowNoise, LinesAreBesideTheHarmonics) {
  const VectorXd d = VectorXd::Random(4 * 100);
  AutoregressiveNoise white;
  white.innovation = white.deviation = 0.6;
  for (const DifferenceLine& line : difference_lines(d, VectorXd::Ones(d.size()), 100, white)) {
    const double harmonics = line.frequency * 100;
    EXPECT_GT(std::abs(harmonics - std::round(harmonics)), 0.16);
    EXPECT_NEAR(line.passed, 1 - std::cos(2 * M_PI * harmonics), 1e-12);
  }
}

TEST(SlowNoise, DensityOfOneOverFIsFound) {
  constexpr int kDraws = 20;
  std::mt19937_64 random(20261123);
  // cycles for a period, and at the end some for a sample
  const std::vector<double> frequencies = {
      0.5 / kSlowPeriod, 1 / kSlowPeriod, 3 / kSlowPeriod, 10 / kSlowPeriod, 0.1, 0.4};
  VectorXd found = VectorXd::Zero(6), alone = VectorXd::Zero(6);
  for (int draw = 0; draw < kDraws; ++draw) {
    const std::vector<JointDifferences> joints = {differences(pink, random),
                                                  differences(pink, random)};
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const JointNoise noise = noise_of_differences(joints, {kSlowPeriod, double{kSlowSamples}})[j];
      EXPECT_FALSE(noise.slow.empty());
      const AutoregressiveNoise& process = joints[j].process;
      for (Index i = 0; i < 6; ++i) {
        const double f = frequencies[static_cast<std::size_t>(i)], truth = pink_density(f);
        found[i] += std::log(noise.density(f) / truth) / (2 * kDraws);
        alone[i] += std::log(density(process, f) / truth) / (2 * kDraws);
      }
    }
  }
  for (Index i = 0; i < 6; ++i) {
    std::printf(
        "%.4f cycles for a sample: density over the true one %.2f, of a process alone %.2f\n",
        frequencies[static_cast<std::size_t>(i)], std::exp(found[i]), std::exp(alone[i]));
    EXPECT_NEAR(found[i], 0, std::log(1.6));
  }
  EXPECT_LT(found.cwiseAbs().maxCoeff(), 0.6 * alone.cwiseAbs().maxCoeff());
}

/// Second differences of white noise, as noise of accelerations is.
constexpr double kEncoder = 20;
void add_encoder(std::mt19937_64& random, VectorXd& series) {
  std::normal_distribution<double> normal;
  VectorXd positions(kSlowSamples + 2);
  for (double& x : positions) x = kEncoder * normal(random);
  series += positions.head(kSlowSamples) - 2 * positions.segment(1, kSlowSamples) +
            positions.tail(kSlowSamples);
}

double encoder_density(double frequency) {
  return std::pow(kEncoder * (2 - 2 * std::cos(2 * M_PI * frequency)), 2);
}

/// Mean logarithms of densities at low lines over the true ones.
struct LowDensities {
  VectorXd found = VectorXd::Zero(3), alone = VectorXd::Zero(3);
};
LowDensities below_encoder(const Series& series, const std::function<double(double)>& density_of,
                           std::mt19937_64& random) {
  constexpr int kDraws = 10;
  const std::vector<double> frequencies = {1 / kSlowPeriod, 3 / kSlowPeriod, 8 / kSlowPeriod};
  const Series both = [&](std::mt19937_64& source) {
    VectorXd sum = series(source);
    add_encoder(source, sum);
    return sum;
  };
  LowDensities low;
  for (int draw = 0; draw < kDraws; ++draw) {
    const std::vector<JointDifferences> joints = {differences(both, random),
                                                  differences(both, random)};
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const JointNoise noise = noise_of_differences(joints, {kSlowPeriod, double{kSlowSamples}})[j];
      const AutoregressiveNoise& process = joints[j].process;
      for (Index i = 0; i < 3; ++i) {
        const double f = frequencies[static_cast<std::size_t>(i)];
        const double truth = density_of(f) + encoder_density(f);
        low.found[i] += std::log(noise.density(f) / truth) / (2 * kDraws);
        low.alone[i] += std::log(density(process, f) / truth) / (2 * kDraws);
      }
    }
  }
  for (Index i = 0; i < 3; ++i) {
    std::printf(
        "%.4f cycles for a sample: density over the true one %.2f, of a process alone %.2f\n",
        frequencies[static_cast<std::size_t>(i)], std::exp(low.found[i]), std::exp(low.alone[i]));
  }
  return low;
}

// a 2400th of the variance each
TEST(SlowNoise, IsFoundBelowNoiseOfAccelerations) {
  std::mt19937_64 random(20261125);
  const LowDensities low = below_encoder(pink, pink_density, random);
  EXPECT_LT(low.found.cwiseAbs().maxCoeff(), std::log(1.4));
}

TEST(SlowNoise, WhiteNoiseIsFoundBelowNoiseOfAccelerations) {
  std::mt19937_64 random(20261125);
  const Series white = [](std::mt19937_64& source) {
    VectorXd series = VectorXd::Zero(kSlowSamples);
    add_first_order(0, 1, source, series);
    return series;
  };
  const LowDensities low = below_encoder(
      white, [](double) { return 1.0; }, random);
  // too much rather than too little: a process of forty lags has no double zero
  EXPECT_LT(low.found.maxCoeff(), std::log(1.5));
  EXPECT_GT(low.found.minCoeff(), std::log(0.9));
  EXPECT_LT(low.alone.minCoeff(), std::log(0.75));
}

TEST(SlowNoise, OfMostJointsStaysWhereOneHasNone) {
  std::mt19937_64 random(20261125);
  constexpr int kDraws = 10;
  double lowest = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const std::vector<JointDifferences> joints = {
        differences(pink, random), differences(pink, random), differences(pink, random),
        differences(first_order, random)};
    const JointNoise noise = noise_of_differences(joints, {kSlowPeriod, double{kSlowSamples}})[0];
    lowest += std::log(noise.density(1 / kSlowPeriod) / pink_density(1 / kSlowPeriod)) / kDraws;
  }
  EXPECT_NEAR(lowest, 0, std::log(1.3));
}

TEST(SlowNoise, OfFirstOrderThereIsHardlyAny) {
  constexpr int kDraws = 40;
  std::mt19937_64 random(20261123);
  double slowest = 0;  // logarithm of the density at the lowest frequencies
  for (int draw = 0; draw < kDraws; ++draw) {
    const JointNoise noise = noise_of_differences({differences(first_order, random)},
                                                  {kSlowPeriod, double{kSlowSamples}})[0];
    slowest +=
        std::log(noise.density(0.5 / kSlowPeriod) / density(SlowNoise{0.95, 1}, 0.5 / kSlowPeriod));
  }
  EXPECT_NEAR(slowest / kDraws, 0, 0.15);
}

}  // namespace
}  // namespace dyngen::runtime
