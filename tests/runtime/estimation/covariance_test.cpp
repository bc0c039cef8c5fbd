// SPDX-License-Identifier: MIT
#include "runtime/estimation/covariance.h"

#include <gtest/gtest.h>

#include <iostream>

#include "tests/runtime/estimation/random_equations.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

/// Parts of all 95 % intervals that contain the truth.
struct Coverage {
  double correlated = 0, white = 0;
};

Coverage measure_coverage(int parameters, Eigen::Index samples, double pole, std::uint64_t seed) {
  constexpr int kRuns = 200;
  const Eigen::Vector2d deviation(2.0, 0.5);
  std::mt19937_64 random(seed);
  Coverage inside;
  for (int run = 0; run < kRuns; ++run) {
    const test::RandomEquations equations(parameters, samples, seed + static_cast<unsigned>(run));
    const RowSource source = equations.source(equations.noisy(pole, deviation, random));
    const TorqueFactor factor = factor_of(source, equations.columns, parameters);
    const Estimate fit = weighted_least_squares(factor);
    NoiseFactor noise = noise_factor(source, equations.columns, fit.beta);
    give_back_fitted_noise(noise, factor, fit.joint_weights, fit.scale, fit.unseen);
    const VectorXd error = (fit.beta - equations.truth).cwiseAbs();
    const double interval = interval_of(factor, noise);
    const auto count = [&](const Eigen::MatrixXd& covariance) {
      const VectorXd bound = interval * covariance.diagonal().cwiseSqrt();
      return static_cast<double>((error.array() < bound.array()).count()) / parameters / kRuns;
    };
    inside.correlated +=
        count(correlated_covariance(factor, noise, fit.joint_weights, fit.scale, fit.unseen));
    inside.white +=
        count(white_covariance(factor, fit.beta, fit.joint_weights, fit.scale, fit.unseen));
  }
  std::cout << "pole " << pole << ", " << samples << " samples, " << parameters
            << " parameters, seed " << seed << ": coverage of 95 % intervals "
            << 100 * inside.correlated << " %, textbook formula " << 100 * inside.white << " %\n";
  return inside;
}

TEST(Covariance, IntervalsHoldWhenNoiseIsCorrelated) {
  for (const auto& [parameters, samples] : {std::pair{10, 3000}, {40, 4000}}) {
    const Coverage coverage = measure_coverage(parameters, samples, 0.9, 20261121);
    EXPECT_GT(coverage.correlated, 0.93);
    EXPECT_LT(coverage.correlated, 0.97);
    EXPECT_LT(coverage.white, 0.8);  // the check can fail: this formula does not hold
  }
}

TEST(Covariance, IntervalsAreALittleShortWhenFewSamplesCount) {
  // 2000 samples with this noise are worth 105: a residual of 20 fitted parameters shows less
  // correlation than the noise has
  const Coverage coverage = measure_coverage(20, 2000, 0.9, 20261121);
  EXPECT_GT(coverage.correlated, 0.92);
  EXPECT_LT(coverage.correlated, 0.97);
}

TEST(Covariance, IntervalsHoldWhenNoiseIsWhite) {
  const Coverage coverage = measure_coverage(20, 2000, 0.0, 7);
  EXPECT_GT(coverage.correlated, 0.93);
  EXPECT_LT(coverage.correlated, 0.97);
  EXPECT_GT(coverage.white, 0.93);
}

}  // namespace
}  // namespace dyngen::runtime
