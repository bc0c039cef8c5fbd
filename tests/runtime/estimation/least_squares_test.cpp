// SPDX-License-Identifier: MIT
#include "runtime/estimation/least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "runtime/estimation/decompositions.h"
#include "runtime/estimation/distributions.h"
#include "runtime/estimation/ridge.h"
#include "runtime/estimation/robust.h"
#include "runtime/estimation/rows.h"
#include "runtime/estimation/significance.h"
#include "runtime/estimation/trust.h"
#include "tests/runtime/estimation/random_equations.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd ones() { return VectorXd::Ones(2); }

TorqueFactor factor_of(const test::RandomEquations& equations, const MatrixXd& tau) {
  return runtime::factor_of(equations.source(tau), equations.columns, equations.parameters);
}

TEST(LeastSquares, FindTheTruthWithoutNoise) {
  const test::RandomEquations equations(12, 600, 1);
  const TorqueFactor factor = factor_of(equations, equations.clean);
  for (const Decomposition decomposition : {Decomposition::kQr, Decomposition::kSvd}) {
    const Estimate fit = least_squares(factor, ones(), {.decomposition = decomposition});
    EXPECT_LT((fit.beta - equations.truth).norm(), 1e-11 * equations.truth.norm());
    EXPECT_EQ(fit.rank, 12);
    EXPECT_EQ(fit.status, EstimateStatus::kDone);
    EXPECT_LT(fit.residual_rms.maxCoeff(), 1e-12);
  }
}

TEST(UnitScale, MakesColumnsOfUnitLength) {
  MatrixXd A(2, 3);
  A << 3, 1e-20, 0, 4, 0, 0;
  EXPECT_DOUBLE_EQ(unit_scale(A)[0], 0.2);
  EXPECT_DOUBLE_EQ(unit_scale(A)[1], 1e20);
  EXPECT_EQ(unit_scale(A)[2], 1);
}

// a right angle is 6e-17 beside pi / 2: the column is rounding
TEST(ClearRounding, LeavesColumnsOfRoundingOfEachJoint) {
  MatrixXd Y(3, 4);
  Y << 9.81, 6e-17, 2e-17, 1e-17,  //
      4, -6e-17, 0, 3e-17,         //
      1, 6e-17, 0, 1e-17;
  MatrixXd cleared = Y;
  clear_rounding(cleared, 2);
  EXPECT_EQ(cleared.col(0), Y.col(0));
  EXPECT_EQ(cleared.col(1), VectorXd::Zero(3));
  EXPECT_EQ(cleared.rightCols(2), Y.rightCols(2));  // all that the other joint has
  MatrixXd none(0, 4);
  clear_rounding(none, 2);
  EXPECT_EQ(none.rows(), 0);
}

TEST(LeastSquares, LeaveUnseenCombinationsAtThePriorAndSaySo) {
  test::RandomEquations equations(6, 400, 2);
  // parameters 1 and 4 act alike: only 2 b1 + 3 b4 is seen
  for (const Index j : {0, 1}) {
    equations.Y.col(j * 6 + 1) = 2.0 / 3 * equations.Y.col(j * 6 + 4);
    equations.clean.col(j) = equations.Y.middleCols(j * 6, 6) * equations.truth;
  }
  equations.columns[1] = {1, 3, 4, 5};
  const TorqueFactor factor = factor_of(equations, equations.clean);
  VectorXd prior = equations.truth;
  prior[1] += 3;
  prior[4] -= 2;  // 2 * 3 - 3 * 2 = 0: as good as the truth
  const Estimate fit = least_squares(factor, ones(), {.prior = prior});
  EXPECT_EQ(fit.rank, 5);
  EXPECT_EQ(fit.status, EstimateStatus::kRankDeficient);
  EXPECT_EQ(fit.unseen.cols(), 1);
  EXPECT_NEAR(2 * fit.beta[1] + 3 * fit.beta[4], 2 * equations.truth[1] + 3 * equations.truth[4],
              1e-10);
  EXPECT_LT((fit.beta - prior).norm(), 1e-9);
  EXPECT_NE(fit.message, "");
}

TEST(LeastSquares, WeightJointsByTheirNoise) {
  std::mt19937_64 random(4);
  double plain = 0, weighted = 0;
  for (int run = 0; run < 30; ++run) {
    const test::RandomEquations equations(10, 500, 100 + static_cast<unsigned>(run));
    const TorqueFactor factor = factor_of(equations, equations.noisy(0, {10.0, 0.1}, random));
    const Estimate fit = weighted_least_squares(factor);
    EXPECT_NEAR(fit.joint_weights[0] * 10.0, 1, 0.2);
    EXPECT_NEAR(fit.joint_weights[1] * 0.1, 1, 0.2);
    // the quiet joint sees the later half
    const auto error = [&](const VectorXd& beta) {
      return (beta - equations.truth).tail(5).squaredNorm();
    };
    weighted += error(fit.beta);
    plain += error(least_squares(factor, ones()).beta);
  }
  EXPECT_LT(weighted, 0.01 * plain);
}

TEST(LeastSquares, RefuseWrongSizes) {
  const test::RandomEquations equations(4, 100, 3);
  const TorqueFactor factor = factor_of(equations, equations.clean);
  EXPECT_THROW(least_squares(factor, VectorXd::Ones(3)), std::invalid_argument);
  EXPECT_THROW(least_squares(factor, VectorXd::Zero(2)), std::invalid_argument);
  EXPECT_THROW(least_squares(factor, ones(), {.prior = VectorXd::Zero(3)}), std::invalid_argument);
}

TEST(Ridge, IsTheWeightedSumOfDataAndPrior) {
  std::mt19937_64 random(6);
  const test::RandomEquations equations(5, 300, 6);
  const TorqueFactor factor = factor_of(equations, equations.noisy(0, {1, 1}, random));
  const Prior prior{VectorXd::Constant(5, 0.3), VectorXd::LinSpaced(5, 0.1, 0.5)};
  const double lambda = 1.7;
  MatrixXd information = MatrixXd::Zero(5, 5);
  VectorXd right = VectorXd::Zero(5);
  for (const JointFactor& joint : factor.joints) {
    const std::size_t j = static_cast<std::size_t>(&joint - factor.joints.data());
    for (std::size_t a = 0; a < factor.columns[j].size(); ++a) {
      const auto column = joint.R.col(static_cast<Index>(a));
      right[factor.columns[j][a]] += column.dot(joint.R.rightCols(1).col(0));
      for (std::size_t b = 0; b < factor.columns[j].size(); ++b) {
        information(factor.columns[j][a], factor.columns[j][b]) +=
            column.dot(joint.R.col(static_cast<Index>(b)));
      }
    }
  }
  for (Index i = 0; i < 5; ++i) {
    const double weight = std::pow(lambda / prior.stddev[i], 2);
    information(i, i) += weight;
    right[i] += weight * prior.beta[i];
  }
  const VectorXd wanted = information.ldlt().solve(right);
  const Estimate fit = ridge(factor, ones(), prior, lambda);
  EXPECT_LT((fit.beta - wanted).norm(), 1e-10 * wanted.norm());
  // noise of 2 N m, white: what the data add to the middle of the sandwich is 4 Y'Y
  NoiseFactor noise = empty_noise(factor.columns);
  for (std::size_t j = 0; j < factor.joints.size(); ++j) {
    noise.F[j] = 2 * factor.joints[j].R.leftCols(static_cast<Index>(factor.columns[j].size()));
  }
  const MatrixXd inverse = information.inverse();
  const MatrixXd drawn = prior.stddev.cwiseAbs2().cwiseInverse().asDiagonal();
  const MatrixXd middle =
      4 * (information - std::pow(lambda, 2) * drawn) + std::pow(lambda, 4) * drawn;
  const MatrixXd covariance = inverse * middle * inverse;
  EXPECT_LT((ridge_covariance(factor, noise, ones(), prior, lambda) - covariance).norm(),
            1e-8 * covariance.norm());
}

TEST(Ridge, RunsFromTheDataToThePriorAlongTheLCurve) {
  std::mt19937_64 random(7);
  const test::RandomEquations equations(8, 300, 8);
  const TorqueFactor factor = factor_of(equations, equations.noisy(0, {2, 2}, random));
  const Prior prior = make_prior(factor, ones(), 1.1 * equations.truth, 0.1);
  const auto curve = l_curve(factor, ones(), prior);
  for (std::size_t i = 1; i < curve.size(); ++i) {
    EXPECT_GE(curve[i].residual, curve[i - 1].residual * (1 - 1e-12));
    EXPECT_LE(curve[i].deviation, curve[i - 1].deviation * (1 + 1e-9));
  }
  const VectorXd far = ridge(factor, ones(), prior, 1e6).beta;
  EXPECT_LT((far - prior.beta).norm(), 1e-6 * prior.beta.norm());
  const double lambda = corner(curve);
  EXPECT_GT(lambda, curve.front().lambda);
  EXPECT_LT(lambda, curve.back().lambda);
}

/// Equations with a parameter that does next to nothing and two that act nearly alike.
struct PoorEquations {
  test::RandomEquations equations{8, 2000, 21};
  TorqueFactor factor;

  explicit PoorEquations(double noise) {
    for (const Index j : {0, 1}) {
      equations.Y.col(j * 8 + 6) = equations.Y.col(j * 8 + 5) + 0.01 * equations.Y.col(j * 8 + 6);
      equations.Y.col(j * 8 + 7) *= 1e-3;
      equations.clean.col(j) = equations.Y.middleCols(j * 8, 8) * equations.truth;
    }
    std::mt19937_64 random(22);
    factor = factor_of(equations, equations.noisy(0, {noise, noise}, random));
  }
};

TEST(Significance, EveryAnalysisLowersTheConditionNumber) {
  const PoorEquations poor(0.5);
  const Significance low = remove_insensitive(poor.factor, ones(), 0.01);
  EXPECT_EQ(low.removed.front(), 7);
  EXPECT_LT(low.condition_after, 0.1 * low.condition_before);
  EXPECT_EQ(low.estimate.beta[7], 0);
  const Significance dependent = remove_dependent(poor.factor, ones(), 30);
  EXPECT_LE(dependent.condition_after, 30);
  EXPECT_GT(dependent.condition_before, 100);
  EXPECT_TRUE(dependent.removed.front() == 5 || dependent.removed.front() == 6);
  const Significance weakest = drop_weakest(poor.factor, ones(), 1);
  EXPECT_LT(weakest.condition_after, 0.1 * weakest.condition_before);
  EXPECT_EQ(weakest.estimate.rank, 7);
  const Significance essential = essential_parameters(poor.factor, ones());
  EXPECT_LT(essential.condition_after, essential.condition_before);
  EXPECT_FALSE(essential.removed.empty());
}

TEST(Significance, WithoutTheWeakestDirectionTheEstimateIsNearerToTheTruth) {
  double full = 0, without = 0;
  const PoorEquations poor(0);
  std::mt19937_64 random(30);
  const VectorXd scale = least_squares(poor.factor, ones()).scale;
  for (int run = 0; run < 40; ++run) {
    const TorqueFactor factor =
        factor_of(poor.equations, poor.equations.noisy(0.9, {3, 3}, random));
    const auto error = [&](const Estimate& fit) {
      return (fit.beta - poor.equations.truth).cwiseQuotient(scale).squaredNorm();
    };
    full += error(least_squares(factor, ones()));
    without += error(drop_weakest(factor, ones(), 1).estimate);
  }
  EXPECT_LT(without, 0.5 * full);
}

TEST(Robust, WildTorquesHaveLittleToSay) {
  double plain = 0, robust = 0;
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int run = 0; run < 10; ++run) {
    const test::RandomEquations equations(6, 800, 40 + static_cast<unsigned>(run));
    MatrixXd tau = equations.noisy(0, {1, 1}, random);
    for (double& value : tau.reshaped()) {
      if (uniform(random) < 0.03) value += 60;
    }
    const RowSource source = equations.source(tau);
    const RobustEstimate fit = iteratively_reweighted(source, equations.columns, 6);
    EXPECT_NEAR(fit.deviation[0], 1, 0.2);
    EXPECT_GT(fit.downweighted[0], 0.02);
    robust += (fit.estimate.beta - equations.truth).squaredNorm();
    plain +=
        (least_squares(factor_of(equations, tau), ones()).beta - equations.truth).squaredNorm();
  }
  EXPECT_LT(robust, 0.1 * plain);
}

TEST(Trust, TheBoundHoldsForEveryPerturbation) {
  // (4.1) with the norms of the perturbations that were made
  std::mt19937_64 random(50);
  std::normal_distribution<double> normal;
  for (int run = 0; run < 20; ++run) {
    const test::RandomEquations equations(6, 300, 60 + static_cast<unsigned>(run));
    test::RandomEquations wrong = equations;
    MatrixXd dY = MatrixXd::Zero(300, 12);
    for (Index j = 0; j < 2; ++j) {
      for (const int c : equations.columns[static_cast<std::size_t>(j)]) {
        for (Index k = 0; k < 300; ++k) dY(k, j * 6 + c) = 0.02 * normal(random);
      }
    }
    wrong.Y += dY;
    const TorqueFactor factor = factor_of(wrong, equations.noisy(0, {0.1, 0.1}, random));
    TorqueFactor noise = empty_factor(equations.columns, 6);
    absorb(noise, dY, MatrixXd::Zero(300, 2));
    const Estimate fit = least_squares(factor, ones());
    const Trust trust = measure_trust(factor, fit, noise, 0.01);
    const VectorXd truth = equations.truth.cwiseQuotient(fit.scale);
    const double error = (fit.beta.cwiseQuotient(fit.scale) - truth).norm();
    EXPECT_LT(error, trust.perturbation_bound * truth.norm() * 1.1) << "seed " << 60 + run;
    EXPECT_LT(trust.perturbation_bound, 1e3);
    EXPECT_GT(trust.worst_bias.minCoeff(), 0);
  }
}

TEST(Trust, KnowsTheBiasThatNoiseInTheRegressorMakes) {
  // (5.2), first term: least squares with a noisy column are too small by R^-1 C beta
  std::mt19937_64 random(51);
  std::normal_distribution<double> normal;
  const test::RandomEquations equations(4, 20000, 70);
  test::RandomEquations wrong = equations;
  for (Index j = 0; j < 2; ++j) {
    for (Index k = 0; k < 20000; ++k) wrong.Y(k, j * 4 + 3) += 0.5 * normal(random);
  }
  const TorqueFactor factor = factor_of(wrong, equations.clean);
  TorqueFactor noise = empty_factor(equations.columns, 4);
  MatrixXd dY = MatrixXd::Zero(20000, 8);
  for (const Index j : {0, 1}) dY.col(j * 4 + 3).setConstant(0.5);
  absorb(noise, dY, MatrixXd::Zero(20000, 2));
  const Estimate fit = least_squares(factor, ones());
  const Trust trust = measure_trust(factor, fit, noise, 0.01);
  const VectorXd bias = equations.truth - fit.beta;
  // to first order: the estimate stands for the truth in it
  EXPECT_LT((bias - trust.attenuation).norm(), 0.25 * bias.norm());
}

TEST(Distributions, AreTheTabulatedOnes) {
  // Student 95 %: 12.706, 2.571, 2.042, 1.960; chi-square 5 %: 3.841, 18.307
  EXPECT_NEAR(student_interval(0.95, 1), 12.706, 1e-3);
  EXPECT_NEAR(student_interval(0.95, 5), 2.571, 1e-3);
  EXPECT_NEAR(student_interval(0.95, 30), 2.042, 1e-3);
  EXPECT_NEAR(student_interval(0.95, 1e6), 1.960, 1e-3);
  EXPECT_NEAR(chi_square_tail(3.841, 1), 0.05, 1e-4);
  EXPECT_NEAR(chi_square_tail(18.307, 10), 0.05, 1e-4);
  EXPECT_THROW(student_interval(1.5, 3), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
