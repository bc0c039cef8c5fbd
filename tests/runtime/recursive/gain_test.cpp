// SPDX-License-Identifier: MIT
#include "runtime/recursive/gain.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>
#include <stdexcept>

#include "tests/runtime/recursive/samples.h"

namespace dyngen::test {
namespace {

using runtime::peak_gain;
using runtime::propose_gain;
using runtime::regressor_correlation;
using runtime::slowest_time_constant;

double largest_eigenvalue(const Eigen::MatrixXd& M) {
  return M.eigenvalues().cwiseAbs().maxCoeff();
}

TEST(ProposeGain, GivesGammaRTheLargestEigenvalueAskedFor) {
  const Samples puma = puma3_samples(1, 0);
  const Eigen::MatrixXd R = regressor_correlation(puma.W, 3);
  for (const double fraction : {0.01, 0.5, 1.9}) {
    const Eigen::MatrixXd GammaR = propose_gain(R, fraction).asDiagonal() * R;
    EXPECT_NEAR(largest_eigenvalue(GammaR), fraction, 1e-12);  // an eigenvalue of a 15 x 15 matrix
  }
}

TEST(ProposeGain, DoesNotDependOnUnits) {
  const Samples puma = puma3_samples(1, 0);
  const Eigen::VectorXd units = Eigen::VectorXd::LinSpaced(15, -6, 6).array().exp();
  const Eigen::VectorXd gain = propose_gain(regressor_correlation(puma.W, 3), 0.5);
  const Eigen::VectorXd other =
      propose_gain(regressor_correlation(puma.W * units.asDiagonal(), 3), 0.5);
  // The gain has the unit of the squared parameter.
  EXPECT_TRUE(other.isApprox(gain.cwiseQuotient(units.cwiseAbs2()), 1e-12));
}

TEST(ProposeGain, LeavesAParameterThatIsNeverExcitedAlone) {
  Samples samples = random_samples(3, 2, 4, 50, 0);
  samples.W.col(2).setZero();
  const Eigen::VectorXd gain = propose_gain(regressor_correlation(samples.W, 2), 0.5);
  EXPECT_EQ(gain[2], 0);
  EXPECT_GT(gain[1], 0);
}

TEST(ProposeGain, RefusesWhatIsNoCorrelation) {
  const Eigen::MatrixXd R = Eigen::MatrixXd::Identity(3, 3);
  EXPECT_THROW(propose_gain(R, 0), std::invalid_argument);
  EXPECT_THROW(propose_gain(R, 2), std::invalid_argument);
  EXPECT_THROW(propose_gain(R.topRows(2), 1), std::invalid_argument);
  EXPECT_THROW(propose_gain(-R, 1), std::invalid_argument);
  EXPECT_THROW(propose_gain(0 * R, 1), std::invalid_argument);
  Eigen::MatrixXd skew = R;
  skew(0, 1) = 1;
  EXPECT_THROW(propose_gain(skew, 1), std::invalid_argument);
}

TEST(PeakGain, IsThatOfTheStrongestSampleAndNotBelowTheMean) {
  const Samples puma = puma3_samples(1, 0);
  const Eigen::VectorXd gain = Eigen::VectorXd::LinSpaced(15, 0.1, 2);
  double largest = 0;
  for (Eigen::Index k = 0; k < puma.size(); ++k) {
    const Eigen::MatrixXd Y = puma.W.middleRows(3 * k, 3);
    largest = std::max(largest, largest_eigenvalue(gain.asDiagonal() * (Y.transpose() * Y)));
  }
  const double peak = peak_gain(gain, puma.W, 3);
  EXPECT_NEAR(peak, largest, 1e-10 * largest);
  EXPECT_GE(peak, largest_eigenvalue(gain.asDiagonal() * regressor_correlation(puma.W, 3)));
}

TEST(SlowestTimeConstant, IsEquation56IfTheGainIsOneNumber) {
  const Samples puma = puma3_samples(1, 0);
  const Eigen::MatrixXd R = regressor_correlation(puma.W, 3);
  const Eigen::VectorXd gain = Eigen::VectorXd::Constant(15, 1e-3);
  const double smallest =
      Eigen::JacobiSVD<Eigen::MatrixXd>(gain.asDiagonal() * R).singularValues().minCoeff();
  EXPECT_NEAR(slowest_time_constant(gain, R, 0.005), 0.005 / smallest, 1e-9 / smallest);
}

TEST(SlowestTimeConstant, IsShorterThanEquation56IfGainsDiffer) {
  const Samples puma = puma3_samples(1, 0);
  const Eigen::MatrixXd R = regressor_correlation(puma.W, 3);
  const Eigen::VectorXd gain = Eigen::VectorXd::LinSpaced(15, 1e-4, 2e-3);
  const double smallest =
      Eigen::JacobiSVD<Eigen::MatrixXd>(gain.asDiagonal() * R).singularValues().minCoeff();
  EXPECT_LT(slowest_time_constant(gain, R, 0.005), 0.99 * 0.005 / smallest);
}

TEST(SlowestTimeConstant, IsInfiniteForASingularCorrelation) {
  Eigen::MatrixXd R = Eigen::MatrixXd::Identity(2, 2);
  R(1, 1) = 0;
  EXPECT_TRUE(std::isinf(slowest_time_constant(Eigen::Vector2d(1, 1), R, 0.001)));
}

}  // namespace
}  // namespace dyngen::test
