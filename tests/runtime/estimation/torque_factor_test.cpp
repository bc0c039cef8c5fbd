// SPDX-License-Identifier: MIT
#include "runtime/estimation/torque_factor.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>

#include "runtime/estimation/least_squares.h"
#include "tests/runtime/estimation/random_equations.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kFactorParameters = 8;

struct Equations {
  test::RandomEquations equations{kFactorParameters, 900, 5};
  MatrixXd tau;
  TorqueFactor factor;

  Equations() {
    std::mt19937_64 random(11);
    tau = equations.noisy(0.5, {1, 1}, random);
    factor = factor_of(equations.source(tau), equations.columns, kFactorParameters);
  }
};

/// Entries of all triangles; the largest difference over the largest entry.
double difference(const TorqueFactor& a, const TorqueFactor& b) {
  double most = 0, size = 0;
  for (std::size_t j = 0; j < a.joints.size(); ++j) {
    most = std::max(most, (a.joints[j].R - b.joints[j].R).cwiseAbs().maxCoeff());
    size = std::max(size, a.joints[j].R.cwiseAbs().maxCoeff());
  }
  return most / size;
}

TEST(TorqueFactor, SumsUpTheNormalEquations) {
  const Equations data;
  for (std::size_t j = 0; j < 2; ++j) {
    const auto& columns = data.equations.columns[j];
    MatrixXd A(data.tau.rows(), static_cast<Index>(columns.size()) + 1);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      A.col(static_cast<Index>(i)) =
          data.equations.Y.col(static_cast<Index>(j) * kFactorParameters + columns[i]);
    }
    A.rightCols(1) = data.tau.col(static_cast<Index>(j));
    const MatrixXd& R = data.factor.joints[j].R;
    const MatrixXd wanted = A.transpose() * A;
    EXPECT_LT((R.transpose() * R - wanted).cwiseAbs().maxCoeff(),
              1e-13 * wanted.cwiseAbs().maxCoeff());
    EXPECT_TRUE((R.diagonal().array() >= 0).all());
    EXPECT_EQ(data.factor.joints[j].rows, 900);
  }
}

TEST(TorqueFactor, DoesNotDependOnBlocks) {
  const Equations data;
  for (const Index block : {1, 7, 64, 900}) {
    const TorqueFactor other = factor_of(data.equations.source(data.tau, block),
                                         data.equations.columns, kFactorParameters);
    EXPECT_LT(difference(data.factor, other), 1e-13) << "blocks of " << block;
  }
}

TEST(TorqueFactor, MergesInAnyOrder) {
  const Equations data;
  std::vector<TorqueFactor> parts;
  for (Index start = 0; start < 900; start += 150) {
    TorqueFactor part = empty_factor(data.equations.columns, kFactorParameters);
    absorb(part, data.equations.Y.middleRows(start, 150), data.tau.middleRows(start, 150));
    parts.push_back(std::move(part));
  }
  std::mt19937_64 random(3);
  for (int order = 0; order < 10; ++order) {
    std::shuffle(parts.begin(), parts.end(), random);
    TorqueFactor left = parts[0], right = parts[3];
    for (const std::size_t i : {1U, 2U}) merge(left, parts[i]);
    for (const std::size_t i : {4U, 5U}) merge(right, parts[i]);
    merge(left, right);
    EXPECT_LT(difference(data.factor, left), 1e-12);
    EXPECT_EQ(left.samples(), 900);
  }
}

TEST(TorqueFactor, KnowsTheResidualOfEveryEstimate) {
  const Equations data;
  const VectorXd beta = data.equations.truth * 0.9;
  const VectorXd squares = residual_squares(data.factor, beta);
  for (Index j = 0; j < 2; ++j) {
    const double wanted =
        (data.tau.col(j) -
         data.equations.Y.middleCols(j * kFactorParameters, kFactorParameters) * beta)
            .squaredNorm();
    EXPECT_NEAR(squares[j], wanted, 1e-12 * wanted);
  }
}

TEST(TorqueFactor, KeepsFewerColumnsAsIfTheyHadBeenAlone) {
  const Equations data;
  const std::vector<int> kept = {0, 2, 5, 7};
  const TorqueFactor fewer = with_columns(data.factor, kept);
  MatrixXd W(1800, 4);
  VectorXd tau(1800);
  for (Index j = 0; j < 2; ++j) {
    const MatrixXd Y = data.equations.Y.middleCols(j * kFactorParameters, kFactorParameters);
    W.middleRows(j * 900, 900) = Y(Eigen::all, kept);
    tau.segment(j * 900, 900) = data.tau.col(j);
  }
  const VectorXd wanted = W.householderQr().solve(tau);
  EXPECT_LT((least_squares(fewer, VectorXd::Ones(2)).beta - wanted).norm(), 1e-11 * wanted.norm());
}

TEST(TorqueFactor, RefusesWhatDoesNotFit) {
  Equations data;
  EXPECT_THROW(absorb(data.factor, data.equations.Y.leftCols(3), data.tau), std::invalid_argument);
  EXPECT_THROW(empty_factor({{0, 9}}, 8), std::invalid_argument);
  TorqueFactor other = empty_factor({{0}, {0}}, 1);
  EXPECT_THROW(merge(data.factor, other), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
