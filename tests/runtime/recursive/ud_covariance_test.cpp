// SPDX-License-Identifier: MIT
#include "runtime/recursive/ud_covariance.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "tests/runtime/recursive/samples.h"

namespace dyngen::test {
namespace {

using runtime::UdCovariance;

Eigen::MatrixXd random_covariance(std::mt19937_64& random, Eigen::Index size, Eigen::Index rank) {
  Eigen::MatrixXd root(size, rank);
  for (Eigen::Index i = 0; i < rank; ++i) root.col(i) = normal_vector(random, size);
  return root * root.transpose();
}

TEST(UdCovariance, FactorsOfAMatrixGiveItBack) {
  std::mt19937_64 random(1);
  for (const Eigen::Index rank : {1, 3, 8, 12}) {
    const Eigen::MatrixXd P = random_covariance(random, 8, rank);
    const UdCovariance factors("P", P);
    EXPECT_TRUE(factors.matrix().isApprox(P, 1e-10));
    EXPECT_GE(factors.D().minCoeff(), 0);
  }
}

TEST(UdCovariance, MeasurementIsTheOneOfTheBook) {
  std::mt19937_64 random(2);
  const Eigen::MatrixXd P = random_covariance(random, 8, 12);
  const Eigen::VectorXd h = normal_vector(random, 8), start = normal_vector(random, 8);
  UdCovariance factors("P", P);
  Eigen::VectorXd x = start;
  const double variance = factors.measure(h.data(), 0.3, 2.0, x);
  const double expected = h.dot(P * h) + 0.3;
  EXPECT_NEAR(variance, expected, 1e-12 * expected);
  EXPECT_TRUE(x.isApprox(start + P * h * (2.0 / expected), 1e-12));
  EXPECT_TRUE(factors.matrix().isApprox(P - P * h * h.transpose() * P / expected, 1e-11));
}

TEST(UdCovariance, SumIsTheSumOfTheMatrices) {
  std::mt19937_64 random(3);
  const Eigen::MatrixXd P = random_covariance(random, 8, 12);
  for (const Eigen::Index rank : {0, 1, 3, 12}) {
    const Eigen::MatrixXd Q = random_covariance(random, 8, rank);
    UdCovariance factors("P", P);
    factors.add(UdCovariance("Q", Q));
    EXPECT_TRUE(factors.matrix().isApprox(P + Q, 1e-12));
  }
  UdCovariance singular("P", random_covariance(random, 8, 2));
  const Eigen::MatrixXd before = singular.matrix();
  singular.add(UdCovariance("Q", P));
  EXPECT_TRUE(singular.matrix().isApprox(before + P, 1e-12));
}

TEST(UdCovariance, RefusesWhatIsNoCovariance) {
  Eigen::Matrix2d P;
  P << 1, 2, 2, 1;  // eigenvalues 3 and -1
  EXPECT_THROW(UdCovariance("P", P), std::invalid_argument);
  P << 1, 0.1, 0.1, 0;
  EXPECT_THROW(UdCovariance("P", P), std::invalid_argument);
  P << 1, 0.1, 0.2, 1;
  EXPECT_THROW(UdCovariance("P", P), std::invalid_argument);
  EXPECT_THROW(UdCovariance("P", Eigen::MatrixXd::Ones(2, 3)), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::test
