// SPDX-License-Identifier: MIT
#include "runtime/excitation/criterion.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <random>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd random_information(unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const MatrixXd W = MatrixXd::NullaryExpr(30, 5, [&] { return normal(random); });
  const Eigen::VectorXd scale = (Eigen::VectorXd(5) << 1, 3, 0.5, 10, 0.2).finished();
  return scale.asDiagonal() * (W.transpose() * W) * scale.asDiagonal();
}

class CriterionGradient : public testing::TestWithParam<std::tuple<Criterion, bool, double>> {};

TEST_P(CriterionGradient, EqualsDifferences) {
  const auto [criterion, unit_columns, power] = GetParam();
  const CriterionOptions options{criterion, unit_columns, power};
  const MatrixXd R = random_information(3);
  const CriterionValue at = evaluate(R, options);
  ASSERT_TRUE(std::isfinite(at.value));
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 10; ++i) {
    MatrixXd step = MatrixXd::NullaryExpr(5, 5, [&] { return normal(random); });
    step = (step + step.transpose()).eval();
    const double h = 1e-5;
    const double difference =
        (evaluate(R + h * step, options).value - evaluate(R - h * step, options).value) / (2 * h);
    const double expected = at.gradient.cwiseProduct(step).sum();
    EXPECT_NEAR(difference, expected, 1e-6 * (1 + std::abs(expected)));
  }
}

INSTANTIATE_TEST_SUITE_P(All, CriterionGradient,
                         testing::Combine(testing::Values(Criterion::kCondition,
                                                          Criterion::kDeterminant,
                                                          Criterion::kTrace, Criterion::kSmallest),
                                          testing::Bool(), testing::Values(1.0, 7.0)));

TEST(Criterion, IsWhatItsNameSays) {
  const MatrixXd R = random_information(5);
  const Eigen::VectorXd lambda = Eigen::SelfAdjointEigenSolver<MatrixXd>(R).eigenvalues();
  const auto value = [&](Criterion criterion, double power) {
    return evaluate(R, {.criterion = criterion, .power = power}).value;
  };
  EXPECT_NEAR(value(Criterion::kDeterminant, 1), -std::log(R.determinant()) / 5, 1e-9);
  EXPECT_NEAR(value(Criterion::kTrace, 1), std::log(R.inverse().trace()), 1e-9);
  EXPECT_NEAR(value(Criterion::kSmallest, 1e4), -std::log(lambda[0]), 1e-3);
  const double condition = 0.5 * std::log(lambda[4] / lambda[0]);
  EXPECT_NEAR(value(Criterion::kCondition, 1e4), condition, 1e-3);
  // smoothed from above, and closer with p
  for (const double power : {1.0, 2.0, 8.0}) {
    EXPECT_GE(value(Criterion::kCondition, power), condition);
    EXPECT_LE(value(Criterion::kCondition, power), condition + std::log(5.0) / power);
  }
}

TEST(Criterion, UnitColumnsDoNotSeeUnits) {
  const MatrixXd R = random_information(6);
  const Eigen::VectorXd scale = (Eigen::VectorXd(5) << 1, 100, 1, 0.01, 1).finished();
  const MatrixXd other = scale.asDiagonal() * R * scale.asDiagonal();
  const CriterionOptions options{.unit_columns = true};
  EXPECT_NEAR(evaluate(R, options).value, evaluate(other, options).value, 1e-9);
  EXPECT_GT(std::abs(evaluate(R, {}).value - evaluate(other, {}).value), 1);
}

TEST(Criterion, OfASingularMatrixIsInfinite) {
  MatrixXd R = random_information(7);
  R.row(2).setZero();
  R.col(2).setZero();
  EXPECT_TRUE(std::isinf(evaluate(R, {}).value));
}

}  // namespace
}  // namespace dyngen::runtime
