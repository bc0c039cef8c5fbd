// SPDX-License-Identifier: MIT
#include "runtime/estimation/instruments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "runtime/estimation/covariance.h"
#include "tests/runtime/estimation/random_equations.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kParameters = 6;
constexpr Index kRows = 1500;

/// A regressor that was measured with noise of this size; the true one is the instrument.
struct NoisyRegressor {
  test::RandomEquations truth;
  MatrixXd measured;
  MatrixXd tau;

  NoisyRegressor(double noise, std::uint64_t seed) : truth(kParameters, kRows, seed) {
    std::mt19937_64 random(seed + 1000);
    std::normal_distribution<double> normal;
    measured = truth.Y;
    for (Index j = 0; j < 2; ++j) {
      for (const int c : truth.columns[static_cast<std::size_t>(j)]) {
        for (Index k = 0; k < kRows; ++k) {
          measured(k, j * kParameters + c) += noise * normal(random);
        }
      }
    }
    tau = truth.noisy(0.7, {1, 1}, random);
  }

  [[nodiscard]] InstrumentSource source() const {
    return [this](const std::function<void(const InstrumentBlock&)>& visit) {
      for (Index start = 0; start < kRows; start += 500) {
        visit({{measured.middleRows(start, 500), tau.middleRows(start, 500), {}, start > 0},
               truth.Y.middleRows(start, 500)});
      }
    };
  }
  [[nodiscard]] TorqueFactor factor() const {
    TorqueFactor sum = empty_factor(truth.columns, kParameters);
    absorb(sum, measured, tau);
    return sum;
  }
};

TEST(Instruments, TakeAwayTheBiasOfANoisyRegressor) {
  VectorXd with = VectorXd::Zero(kParameters), without = with;
  constexpr int kRuns = 40;
  for (int run = 0; run < kRuns; ++run) {
    const NoisyRegressor data(1.0, 200 + static_cast<unsigned>(run));
    const InstrumentalEstimate iv =
        instrumental_variables(data.source(), data.truth.columns, kParameters, VectorXd::Ones(2));
    const VectorXd sign = data.truth.truth.cwiseSign();
    with += sign.cwiseProduct(iv.estimate.beta - data.truth.truth) / kRuns;
    without +=
        sign.cwiseProduct(least_squares(data.factor(), VectorXd::Ones(2)).beta - data.truth.truth) /
        kRuns;
    EXPECT_GT(iv.relevance, 0.1);
  }
  EXPECT_LT(without.mean(), -0.05);  // too small, as noise in a regressor makes it
  EXPECT_LT(std::abs(with.mean()), 0.25 * std::abs(without.mean()));
}

TEST(Instruments, StatedIntervalsHold) {
  int inside = 0;
  constexpr int kRuns = 100;
  for (int run = 0; run < kRuns; ++run) {
    const NoisyRegressor data(0.5, 300 + static_cast<unsigned>(run));
    const InstrumentalEstimate iv =
        instrumental_variables(data.source(), data.truth.columns, kParameters, VectorXd::Ones(2));
    const VectorXd error = (iv.estimate.beta - data.truth.truth).cwiseAbs();
    inside += static_cast<int>((error.array() < 1.96 * iv.estimate.stddev().array()).count());
  }
  const double coverage = static_cast<double>(inside) / (kRuns * kParameters);
  std::cout << "coverage of 95 % intervals, seeds 300..399: " << 100 * coverage << " %\n";
  EXPECT_GT(coverage, 0.915);  // 100 runs: one standard deviation is 0.9 %
  EXPECT_LT(coverage, 0.98);
}

TEST(DurbinWuHausman, RejectsWhenTheRegressorIsNoisyAndRarelyWhenItIsNot) {
  int noisy = 0, clean = 0;
  constexpr int kRuns = 60;
  for (int run = 0; run < kRuns; ++run) {
    const auto p_value = [&](double noise) {
      const NoisyRegressor data(noise, 500 + static_cast<unsigned>(run));
      return instrumental_variables(data.source(), data.truth.columns, kParameters,
                                    VectorXd::Ones(2))
          .p_value;
    };
    noisy += p_value(1.0) < 0.05 ? 1 : 0;
    // the same sizes, but torque follows the measured regressor: nothing is wrong with it
    NoisyRegressor right(1.0, 900 + static_cast<unsigned>(run));
    for (Index j = 0; j < 2; ++j) {
      right.tau.col(j) +=
          (right.measured - right.truth.Y).middleCols(j * kParameters, kParameters) *
          right.truth.truth;
    }
    clean +=
        instrumental_variables(right.source(), right.truth.columns, kParameters, VectorXd::Ones(2))
                    .p_value < 0.05
            ? 1
            : 0;
  }
  std::cout << "rejected at 5 %, seeds 500..559, 900..959: noisy " << noisy << ", exogenous "
            << clean << " of " << kRuns << "\n";
  EXPECT_GT(noisy, 0.9 * kRuns);
  EXPECT_LE(clean, 8);  // binomial(60, 0.05): 8 or fewer in 99.4 %
}

}  // namespace
}  // namespace dyngen::runtime
