// SPDX-License-Identifier: MIT
#include "runtime/estimation/covariance.h"

#include <gtest/gtest.h>

#include <iostream>

#include "runtime/estimation/joint_noise.h"
#include "runtime/estimation/ridge.h"
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

/// White noise with some beside it that is as slow as the motion.
constexpr double kSlowPole = 0.999;
const Eigen::Vector2d kQuick(2.0, 0.5), kSlow(0.8, 0.2);

KnownNoise known_noise() {
  KnownNoise noise;
  noise.correlation_time = VectorXd::Ones(2);
  for (Eigen::Index j = 0; j < 2; ++j) {
    JointNoise joint;
    joint.quick.innovation = joint.quick.deviation = kQuick[j];
    joint.slow = {{kSlowPole, kSlow[j]}};
    noise.parts.push_back(joint.parts());
  }
  return noise;
}

TEST(Covariance, KnownNoiseIsAllOfItsProductsOfSamples) {
  constexpr Eigen::Index kSamples = 150;
  constexpr int kParameters = 6;
  const test::RandomEquations equations(kParameters, kSamples, 3);
  const KnownNoise noise = known_noise();
  const NoiseFactor factor =
      noise_factor(equations.source(equations.clean, 40), equations.columns, kParameters, noise);
  for (Eigen::Index j = 0; j < 2; ++j) {
    const auto& columns = equations.columns[static_cast<std::size_t>(j)];
    Eigen::MatrixXd Y(kSamples, static_cast<Eigen::Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) {
      Y.col(static_cast<Eigen::Index>(i)) = equations.Y.col(j * kParameters + columns[i]);
    }
    Eigen::MatrixXd covariance(kSamples, kSamples);
    for (Eigen::Index a = 0; a < kSamples; ++a) {
      for (Eigen::Index b = 0; b < kSamples; ++b) {
        covariance(a, b) =
            kSlow[j] * kSlow[j] * std::pow(kSlowPole, static_cast<double>(std::abs(a - b))) +
            (a == b ? kQuick[j] * kQuick[j] : 0);
      }
    }
    const Eigen::MatrixXd expected = Y.transpose() * covariance * Y;
    const Eigen::MatrixXd& F = factor.F[static_cast<std::size_t>(j)];
    EXPECT_LT((F.transpose() * F - expected).cwiseAbs().maxCoeff(),
              1e-4 * expected.cwiseAbs().maxCoeff());
    EXPECT_NEAR(factor.power[j], kSamples * (kQuick[j] * kQuick[j] + kSlow[j] * kSlow[j]), 1e-9);
  }
}

TEST(Covariance, IntervalsByKnownNoiseHoldWhereTheResidualHidesWhatIsSlow) {
  constexpr int kRuns = 200, kParameters = 20;
  std::mt19937_64 random(20261127);
  double known = 0, of_residual = 0;
  for (int run = 0; run < kRuns; ++run) {
    const test::RandomEquations equations(kParameters, 2000, 4000 + static_cast<unsigned>(run));
    const RowSource source =
        equations.source(equations.noisy(0, kQuick, random) +
                         equations.noisy(kSlowPole, kSlow, random) - equations.clean);
    const TorqueFactor factor = factor_of(source, equations.columns, kParameters);
    const Estimate fit = weighted_least_squares(factor);
    NoiseFactor noise = noise_factor(source, equations.columns, fit.beta);
    give_back_fitted_noise(noise, factor, fit.joint_weights, fit.scale, fit.unseen);
    const auto inside = [&](const NoiseFactor& by) {
      const VectorXd bound =
          1.96 * correlated_covariance(factor, by, fit.joint_weights, fit.scale, fit.unseen)
                     .diagonal()
                     .cwiseSqrt();
      const VectorXd error = (fit.beta - equations.truth).cwiseAbs();
      return static_cast<double>((error.array() < bound.array()).count()) / kParameters / kRuns;
    };
    of_residual += inside(noise);
    known += inside(noise_factor(source, equations.columns, kParameters, known_noise()));
  }
  std::cout << "slow noise beside white: coverage of 95 % intervals by known noise " << 100 * known
            << " %, by that of the residual " << 100 * of_residual << " %\n";
  EXPECT_GT(known, 0.93);
  EXPECT_LT(known, 0.97);
  EXPECT_LT(of_residual, 0.93);  // the check can fail: an autoregressive residual does not hold
}

/// Truths drawn from the prior: how often intervals of the ridge estimate contain them.
double coverage_of_ridge(double lambda) {
  constexpr int kRuns = 200, kParameters = 10;
  std::mt19937_64 random(20261121);
  std::normal_distribution<double> normal;
  double inside = 0;
  for (int run = 0; run < kRuns; ++run) {
    const test::RandomEquations equations(kParameters, 1500, 900 + static_cast<unsigned>(run));
    Prior prior{VectorXd::Constant(kParameters, 1.0), VectorXd::Constant(kParameters, 0.2)};
    VectorXd truth = prior.beta;
    for (double& value : truth) value += 0.2 * normal(random);
    // the rows of these equations, with the truth of this run
    Eigen::MatrixXd tau = equations.noisy(0.9, {4.0, 4.0}, random);
    for (Eigen::Index j = 0; j < 2; ++j) {
      tau.col(j) +=
          equations.Y.middleCols(j * kParameters, kParameters) * (truth - equations.truth);
    }
    const RowSource source = equations.source(tau);
    const TorqueFactor factor = factor_of(source, equations.columns, kParameters);
    const VectorXd weights = VectorXd::Constant(2, 1 / 4.0);
    const Estimate fit = ridge(factor, weights, prior, lambda);
    NoiseFactor noise = noise_factor(source, equations.columns, fit.beta);
    give_back_fitted_noise(noise, factor, weights, fit.scale, fit.unseen);
    const VectorXd bound =
        1.96 * ridge_covariance(factor, noise, weights, prior, lambda).diagonal().cwiseSqrt();
    inside += static_cast<double>(((fit.beta - truth).array().abs() < bound.array()).count());
  }
  return inside / kRuns / kParameters;
}

TEST(Covariance, IntervalsOfRidgeHoldWhateverLambdaIs) {
  for (const double lambda : {0.3, 1.0, 3.0, 10.0}) {
    const double coverage = coverage_of_ridge(lambda);
    std::cout << "ridge, lambda " << lambda << ": coverage " << 100 * coverage << " %\n";
    EXPECT_GT(coverage, 0.93) << lambda;
    EXPECT_LT(coverage, 0.97) << lambda;
  }
}

}  // namespace
}  // namespace dyngen::runtime
