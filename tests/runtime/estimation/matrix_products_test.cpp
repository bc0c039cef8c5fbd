// SPDX-License-Identifier: MIT
#include "runtime/estimation/matrix_products.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <thread>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd random_matrix(Index rows, Index columns, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  MatrixXd matrix(rows, columns);
  for (double& value : matrix.reshaped()) value = normal(random);
  return matrix;
}

/// Entry by entry.
MatrixXd by_definition(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd product = MatrixXd::Zero(A.rows(), B.cols());
  for (Index i = 0; i < A.rows(); ++i) {
    for (Index j = 0; j < B.cols(); ++j) {
      for (Index k = 0; k < A.cols(); ++k) product(i, j) += A(i, k) * B(k, j);
    }
  }
  return product;
}

TEST(MatrixProducts, AreThoseOfTheDefinition) {
  std::mt19937_64 random(1);
  for (const Index rows : {1, 7, 64, 500}) {
    for (const Index columns : {1, 3, 40}) {
      const MatrixXd A = random_matrix(rows, 33, random), B = random_matrix(rows, columns, random);
      const double tolerance = 1e-13 * static_cast<double>(rows + 33);
      const MatrixXd product = transposed_product(A, B);
      EXPECT_LT((product - by_definition(A.transpose(), B)).cwiseAbs().maxCoeff(), tolerance);
      MatrixXd C = random_matrix(rows, columns, random);
      const MatrixXd expected = C - by_definition(A, product);
      subtract_product(A, product, C);
      EXPECT_LT((C - expected).cwiseAbs().maxCoeff(), 100 * tolerance);
    }
  }
}

TEST(MatrixProducts, OfBlocksTouchNothingBesideThem) {
  std::mt19937_64 random(2);
  const MatrixXd A = random_matrix(90, 12, random), B = random_matrix(80, 9, random);
  const auto part = A.block(20, 3, 50, 6);
  const MatrixXd inner = transposed_product(part, B.middleRows(10, 50));
  EXPECT_LT((inner - by_definition(part.transpose(), B.middleRows(10, 50))).cwiseAbs().maxCoeff(),
            1e-12);
  const MatrixXd before = random_matrix(70, 9, random);
  MatrixXd C = before;
  subtract_product(part, inner, C.middleRows(5, 50));
  EXPECT_EQ(C.topRows(5), before.topRows(5));
  EXPECT_EQ(C.bottomRows(15), before.bottomRows(15));
  EXPECT_LT((C.middleRows(5, 50) - before.middleRows(5, 50) + by_definition(part, inner))
                .cwiseAbs()
                .maxCoeff(),
            1e-11);
}

TEST(MatrixProducts, OfNothingAreNothing) {
  const MatrixXd none(10, 0), some = MatrixXd::Ones(10, 2), flat(0, 3);
  EXPECT_EQ(transposed_product(none, some).rows(), 0);
  EXPECT_EQ(transposed_product(some, none).cols(), 0);
  EXPECT_EQ(transposed_product(flat, flat), MatrixXd::Zero(3, 3));
  MatrixXd C = some;
  subtract_product(none, MatrixXd(0, 2), C);
  EXPECT_EQ(C, some);
}

/// Work space that threads share without a guard makes some of them wrong.
TEST(MatrixProducts, OfThreadsAtOnceAreThoseOfOne) {
  std::mt19937_64 random(3);
  const MatrixXd A = random_matrix(200, 12, random), B = random_matrix(200, 16, random);
  const MatrixXd expected = transposed_product(A, B);
  std::atomic<int> wrong = 0;
  const auto work = [&] {
    for (int i = 0; i < 20000; ++i) wrong += transposed_product(A, B) != expected ? 1 : 0;
  };
  std::thread other(work);
  work();
  other.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace dyngen::runtime
