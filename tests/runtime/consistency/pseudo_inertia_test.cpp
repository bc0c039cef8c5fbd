// SPDX-License-Identifier: MIT
#include "runtime/consistency/pseudo_inertia.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

LogCholesky random_coordinates(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  LogCholesky theta;
  for (int k = 0; k < 10; ++k) theta[k] = normal(random);
  return theta;
}

TEST(PseudoInertia, OfAPointMassIsTheProductOfItsHomogeneousPosition) {
  const double m = 3, x = 0.2, y = -0.5, z = 0.7;
  TenParameters ten;
  ten << m * (y * y + z * z), -m * x * y, -m * x * z, m * (x * x + z * z), -m * y * z,
      m * (x * x + y * y), m * x, m * y, m * z, m;
  const Eigen::Vector4d place(x, y, z, 1);
  EXPECT_LT((pseudo_inertia(ten) - m * place * place.transpose()).norm(), 1e-14);
}

TEST(PseudoInertia, AndTenParametersAreInverse) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    const TenParameters ten = random_coordinates(seed);
    EXPECT_LT((ten_parameters(pseudo_inertia(ten)) - ten).norm(), 1e-14 * ten.norm());
  }
}

TEST(PseudoInertia, BallIsConsistentAndRodPointAndNonsenseAreNot) {
  TenParameters ball = TenParameters::Zero();
  ball[0] = ball[3] = ball[5] = 0.4;
  ball[9] = 1;
  EXPECT_TRUE(is_consistent(ball));
  EXPECT_NEAR(smallest_eigenvalue(ball), 0.2, 1e-15);

  TenParameters broken = ball;  // XX > YY + ZZ
  broken[0] = 0.81;
  EXPECT_FALSE(is_consistent(broken));
  EXPECT_NEAR(smallest_eigenvalue(broken), -0.005, 1e-15);

  TenParameters off_centre = ball;  // the centre of mass is outside of what the tensor allows
  off_centre[6] = 0.5;
  EXPECT_FALSE(is_consistent(off_centre));

  EXPECT_FALSE(is_consistent(TenParameters::Zero()));
  TenParameters unknown = ball;
  unknown[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_consistent(unknown));
  EXPECT_TRUE(std::isnan(smallest_eigenvalue(unknown)));
}

TEST(LogCholesky, EveryTenNumbersAreAConsistentBody) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    EXPECT_TRUE(is_consistent(ten_parameters(from_log_cholesky(random_coordinates(seed)))));
  }
}

TEST(LogCholesky, RoundTripKeepsTwelveDigits) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    const LogCholesky theta = random_coordinates(seed);
    const Eigen::Matrix4d J = from_log_cholesky(theta);
    // Coordinates lose what the matrix's condition costs; the matrix itself loses nothing.
    const double condition = J.norm() / smallest_eigenvalue(ten_parameters(J));
    EXPECT_LT((from_log_cholesky(log_cholesky(J)) - J).norm(), 1e-12 * J.norm());
    EXPECT_LT((log_cholesky(J) - theta).norm(), 1e-12 + 1e-15 * condition);
  }
}

TEST(LogCholesky, JacobianIsThatOfFiniteDifferences) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    const LogCholesky theta = random_coordinates(seed);
    const Eigen::Matrix<double, 10, 10> jacobian = log_cholesky_jacobian(theta);
    const double h = 1e-5;  // error h^2 times a third derivative, and 1e-16 / h
    for (int k = 0; k < 10; ++k) {
      LogCholesky up = theta, down = theta;
      up[k] += h;
      down[k] -= h;
      const TenParameters difference =
          (ten_parameters(from_log_cholesky(up)) - ten_parameters(from_log_cholesky(down))) /
          (2 * h);
      EXPECT_LT((jacobian.col(k) - difference).norm(), 1e-8 * jacobian.norm());
    }
  }
}

TEST(LogCholesky, OfWhatIsNotPositiveDefiniteThrows) {
  EXPECT_THROW(log_cholesky(Eigen::Matrix4d::Zero()), std::invalid_argument);
  EXPECT_THROW(log_cholesky(Eigen::Vector4d(1, 1, -1, 1).asDiagonal()), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
