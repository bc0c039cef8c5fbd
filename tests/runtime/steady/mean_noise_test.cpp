// SPDX-License-Identifier: MIT
#include "runtime/steady/mean_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "runtime/estimation/distributions.h"
#include "tests/runtime/steady/made_steady.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// 24 stretches of 6 s, a second apart, of one noise; their means less each own's neighbour.
struct MeansOfNoise {
  int held = 0, held_apart = 0, all = 0, all_apart = 0;
};

MeansOfNoise means_of(const test::MadeNoise& made, unsigned simulations) {
  const SteadyRules rules;
  constexpr double kStep = 0.01;
  constexpr Index kCount = 600, kGap = 100, kStretches = 24;
  MeansOfNoise result;
  for (unsigned seed = 0; seed < simulations; ++seed) {
    std::mt19937 random(seed);
    const VectorXd x = test::noise_of(made, kStretches * (kCount + kGap), kStep, random);
    std::vector<CosinePowers> powers;
    std::vector<Stretch> stretches;
    std::vector<double> means;
    for (Index r = 0; r < kStretches; ++r) {
      const Index first = r * (kCount + kGap);
      stretches.push_back({first, kCount, kStep, static_cast<double>(first) * kStep, 0});
      const VectorXd part = x.segment(first, kCount);
      means.push_back(part.mean());
      powers.push_back(cosine_powers(stretches.back(), part.array() - part.mean(), rules));
    }
    const MeanNoise noise = fit_mean_noise(powers, rules);
    const Eigen::MatrixXd covariance = covariance_of_means(noise, stretches);
    const double t = student_interval(0.95, noise.degrees);
    for (Index r = 0; r < kStretches; ++r) {
      result.held +=
          std::abs(means[static_cast<std::size_t>(r)]) <= t * std::sqrt(covariance(r, r));
      ++result.all;
      if (r % 2 == 0) continue;
      const double apart =
          means[static_cast<std::size_t>(r)] - means[static_cast<std::size_t>(r - 1)];
      const double variance =
          covariance(r, r) + covariance(r - 1, r - 1) - 2 * covariance(r, r - 1);
      result.held_apart += std::abs(apart) <= t * std::sqrt(variance);
      ++result.all_apart;
    }
  }
  return result;
}

void expect_coverage(const char* what, int held, int all) {
  const double percent = 100.0 * held / all;
  std::cout << what << ", seeds 0 to 199: " << held << " of " << all << " intervals hold, "
            << percent << " %\n";
  EXPECT_GE(percent, 93) << what;
  EXPECT_LE(percent, 98) << what;  // few slow cosines: intervals are rather too wide
}

TEST(MeanNoise, IntervalsOfMeansHoldWithWhiteNoise) {
  const MeansOfNoise own = means_of({.white = 0.3, .memory = {}, .deviation = {}}, 200);
  expect_coverage("white noise, means", own.held, own.all);
  expect_coverage("white noise, differences", own.held_apart, own.all_apart);
}

TEST(MeanNoise, IntervalsOfMeansHoldWithNoiseThatIsForgottenInAThirdOfASecond) {
  const MeansOfNoise own = means_of({.white = 0.3, .memory = {0.3}, .deviation = {0.2}}, 200);
  expect_coverage("0.3 s, means", own.held, own.all);
  expect_coverage("0.3 s, differences", own.held_apart, own.all_apart);
}

TEST(MeanNoise, IntervalsOfMeansHoldWithNoiseThatIsForgottenInTwoSeconds) {
  const MeansOfNoise own = means_of({.white = 0.3, .memory = {2}, .deviation = {0.2}}, 200);
  expect_coverage("2 s, means", own.held, own.all);
  expect_coverage("2 s, differences", own.held_apart, own.all_apart);
}

TEST(MeanNoise, IntervalsOfDifferencesHoldWithNoiseLikeOneOverF) {
  const MeansOfNoise own = means_of(test::pink_noise(), 200);
  // what is slower than four runs is the same in both runs of a pair, and not in a mean's interval
  expect_coverage("1/f, differences", own.held_apart, own.all_apart);
  std::cout << "1/f, means: " << 100.0 * own.held / own.all << " %\n";
}

TEST(MeanNoise, VarianceOfAMeanOfWhiteNoiseIsItsDensityOverTheTime) {
  MeanNoise noise;
  noise.density = 0.02;
  const Stretch one{0, 100, 0.01, 0, 0}, other{200, 100, 0.01, 2, 0};
  EXPECT_DOUBLE_EQ(noise.of_means(one, one), 0.02);
  EXPECT_DOUBLE_EQ(noise.of_means(one, other), 0);
}

TEST(MeanNoise, MeansOfTwoRecordingsShareNoNoise) {
  MeanNoise noise;
  noise.memory = VectorXd::Constant(1, 100);
  noise.variance = VectorXd::Constant(1, 1);
  Stretch one{0, 100, 0.01, 0, 0}, other{0, 100, 0.01, 0, 1};
  EXPECT_EQ(noise.of_means(one, other), 0);
  EXPECT_NEAR(noise.of_means(one, one), 1, 0.01);
}

}  // namespace
}  // namespace dyngen::runtime
