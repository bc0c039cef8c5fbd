// SPDX-License-Identifier: MIT
#include "runtime/estimation/errors_in_variables.h"

#include <gtest/gtest.h>

#include <iostream>

#include "runtime/estimation/covariance.h"
#include "tests/runtime/estimation/random_equations.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kColumns = 5, kNoisy = 3;

/// Equations of which one column has been measured with noise.
struct NoisyColumn {
  /// @param moved  of the column's usual size       @param size  standard deviation of its noise
  NoisyColumn(Index samples, double moved, double size, std::uint64_t seed)
      : equations(kColumns, samples, seed) {
    for (const Index j : {0, 1}) {
      equations.Y.col(j * kColumns + kNoisy) *= moved;
      equations.clean.col(j) = equations.Y.middleCols(j * kColumns, kColumns) * equations.truth;
    }
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const MatrixXd torque = equations.noisy(0, {0.05, 0.05}, random);
    test::RandomEquations measured = equations;
    MatrixXd dY = MatrixXd::Zero(samples, 2 * kColumns);
    for (const Index j : {0, 1}) {
      for (Index k = 0; k < samples; ++k) {
        measured.Y(k, j * kColumns + kNoisy) += size * normal(random);
      }
      dY.col(j * kColumns + kNoisy).setConstant(size);
    }
    factor = factor_of(measured.source(torque), equations.columns, kColumns);
    noise = empty_factor(equations.columns, kColumns);
    absorb(noise, dY, MatrixXd::Zero(samples, 2));
    fit = weighted_least_squares(factor);
  }

  test::RandomEquations equations;
  TorqueFactor factor, noise;
  Estimate fit;
};

/// Parts of the parameters within their 95 % interval, with the term and without it.
std::pair<double, double> coverage(Index samples, double moved, double size,
                                   std::uint64_t seed) {
  constexpr int kRuns = 200;
  double with = 0, without = 0;
  for (unsigned run = 0; run < kRuns; ++run) {
    const NoisyColumn data(samples, moved, size, seed + run);
    const MatrixXd sampling =
        white_covariance(data.factor, data.fit.beta, data.fit.joint_weights, data.fit.scale, {});
    const MatrixXd all = sampling + errors_in_variables(data.factor, data.fit, data.noise);
    const VectorXd error = (data.fit.beta - data.equations.truth).cwiseAbs();
    const auto inside = [&](const MatrixXd& covariance) {
      return static_cast<double>(
                 (error.array() < 1.96 * covariance.diagonal().array().sqrt()).count()) /
             kColumns / kRuns;
    };
    with += inside(all);
    without += inside(sampling);
  }
  std::cout << samples << " samples, motion " << moved << ", noise " << size << ", seed " << seed << ": "
            << 100 * with << " % inside, without the term " << 100 * without << " %\n";
  return {with, without};
}

TEST(ErrorsInVariables, IntervalsContainTheTruthWhateverTheNoiseOfTheRegressor) {
  for (const Index samples : {30, 300}) {
    for (const auto& [moved, size] : {std::pair{1.0, 0.05}, {1.0, 0.2}, {1.0, 0.5}, {0.01, 0.5}}) {
      EXPECT_GT(coverage(samples, moved, size, 20261128).first, 0.93) << samples << " " << size;
    }
  }
  EXPECT_LT(coverage(300, 1, 0.5, 20261128).second, 0.8);  // the check can fail
}

TEST(ErrorsInVariables, AddNothingWithoutNoise) {
  const NoisyColumn data(300, 1, 0, 1);
  EXPECT_EQ(errors_in_variables(data.factor, data.fit, data.noise).norm(), 0);
  TorqueFactor none;
  EXPECT_EQ(errors_in_variables(data.factor, data.fit, none).norm(), 0);
}

TEST(ErrorsInVariables, AddTheBiasOfTheNoisyParameterAlone) {
  const NoisyColumn data(20000, 1, 0.5, 3);
  const MatrixXd added = errors_in_variables(data.factor, data.fit, data.noise);
  const double bias = std::abs(data.equations.truth[kNoisy] - data.fit.beta[kNoisy]);
  EXPECT_NEAR(std::sqrt(added(kNoisy, kNoisy)), bias, 0.1 * bias);
}

}  // namespace
}  // namespace dyngen::runtime
