// SPDX-License-Identifier: MIT
#include "runtime/recursive/lms.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <stdexcept>

#include "runtime/recursive/gain.h"
#include "tests/runtime/recursive/samples.h"

namespace dyngen::test {
namespace {

using runtime::Lms;
using runtime::LmsOptions;

TEST(Lms, StepIsEquation51) {
  const Samples samples = random_samples(1, 3, 5, 1, 0.1);
  LmsOptions options{.gain = Eigen::VectorXd::LinSpaced(5, 0.1, 0.5)};
  options.joint_weights = Eigen::Vector3d(1, 0.5, 0);
  options.start = Eigen::VectorXd::LinSpaced(5, -1, 1);
  Lms lms(3, options);
  ASSERT_TRUE(lms.update(samples.Y(0), samples.torque(0)));
  const Eigen::VectorXd step = options.gain.asDiagonal() * samples.W.transpose() *
                               options.joint_weights.asDiagonal() *
                               (samples.tau - samples.W * options.start);
  EXPECT_TRUE(lms.beta().isApprox(options.start + step, 1e-14));
}

/// |tau - Y beta| of one sample given 2000 times, its Gamma Y'Y having the largest eigenvalue
/// `peak`.
double residual_after(double peak, bool normalised) {
  const Samples samples = random_samples(2, 3, 15, 1, 0);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(15);
  LmsOptions options{.gain = peak / runtime::peak_gain(ones, samples.W, 3) * ones};
  options.normalised = normalised;
  options.step = 1.9;
  Lms lms(3, options);
  feed(lms, samples, 2000);
  return (samples.tau - samples.W * lms.beta()).norm() / samples.tau.norm();
}

TEST(Lms, ConvergesBelowAPeakGainOfTwoAndDivergesAbove) {
  EXPECT_LT(residual_after(1.98, false), 1e-12);  // 0.98^2000 = 3e-18, rounding is left
  EXPECT_GT(residual_after(2.02, false), 1e12);   // 1.02^2000 = 2e17
}

TEST(Lms, NormalisedConvergesWhateverTheGain) {
  EXPECT_LT(residual_after(2.02, true), 1e-12);
  EXPECT_LT(residual_after(1e9, true), 1e-12);
}

TEST(Lms, NoSampleEnlargesTheErrorBelowTheBound) {
  const Samples puma = puma3_samples(1, 0);
  const Eigen::VectorXd shape = Eigen::VectorXd::LinSpaced(15, 0.2, 3);
  const Eigen::VectorXd gain = 1.99 / runtime::peak_gain(shape, puma.W, 3) * shape;
  Lms lms(3, {.gain = gain});
  const auto error = [&] { return (lms.beta() - puma.beta).cwiseAbs2().cwiseQuotient(gain).sum(); };
  for (int pass = 0; pass < 5; ++pass) {
    for (Eigen::Index k = 0; k < puma.size(); ++k) {
      const double before = error();
      ASSERT_TRUE(lms.update(puma.Y(k), puma.torque(k)));
      EXPECT_LE(error(), before * (1 + 1e-12));
    }
  }
}

TEST(Lms, ProposedGainConvergesWhereOneNumberDoesNotInOtherUnits) {
  Samples puma = puma3_samples(1, 0);
  const Eigen::VectorXd units = Eigen::VectorXd::LinSpaced(15, -3, 3).array().exp();
  puma.W = (puma.W * units.asDiagonal()).eval();
  puma.beta = puma.beta.cwiseQuotient(units);
  const auto distance_after = [&](Eigen::VectorXd gain) {
    gain *= 1 / runtime::peak_gain(gain, puma.W, 3);
    Lms lms(3, {.gain = gain});
    feed(lms, puma, 200);
    return (lms.beta() - puma.beta).cwiseProduct(units).norm() /
           puma.beta.cwiseProduct(units).norm();
  };
  const Eigen::MatrixXd R = runtime::regressor_correlation(puma.W, 3);
  EXPECT_LT(distance_after(runtime::propose_gain(R, 0.1)), 1e-3);
  EXPECT_GT(distance_after(Eigen::VectorXd::Ones(15)), 0.1);
}

/// Of the error over the passes 200 to 400, in seconds: every sample once a pass.
double measured_time_constant(const Samples& samples, const Eigen::VectorXd& gain,
                              double sample_time) {
  Lms lms(samples.joints, {.gain = gain});
  const auto error = [&] {
    return std::sqrt((lms.beta() - samples.beta).cwiseAbs2().cwiseQuotient(gain).sum());
  };
  feed(lms, samples, 200);
  const double before = error();
  feed(lms, samples, 200);
  const auto count = static_cast<double>(200 * samples.size());
  return count * sample_time / std::log(before / error());
}

TEST(Lms, SlowestDecayIsThatOfEquation56) {
  const Samples puma = puma3_samples(1, 0);
  const Eigen::MatrixXd R = runtime::regressor_correlation(puma.W, 3);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(15);
  const Eigen::VectorXd gain = 0.05 / runtime::peak_gain(ones, puma.W, 3) * ones;
  const double sigma =
      Eigen::JacobiSVD<Eigen::MatrixXd>(gain.asDiagonal() * R).singularValues().minCoeff();
  const double measured = measured_time_constant(puma, gain, 0.005);
  std::printf("common gain: measured %.4f s, eq. 5.6 %.4f s\n", measured, 0.005 / sigma);
  EXPECT_NEAR(measured, 0.005 / sigma, 0.03 * 0.005 / sigma);  // 5.6 holds for slow adaptation
}

TEST(Lms, SlowestDecayFollowsTheEigenvalueNotTheSingularValue) {
  const Samples puma = puma3_samples(1, 0);
  const Eigen::MatrixXd R = runtime::regressor_correlation(puma.W, 3);
  const Eigen::VectorXd shape = Eigen::VectorXd::LinSpaced(15, 0.2, 3);
  const Eigen::VectorXd gain = 0.05 / runtime::peak_gain(shape, puma.W, 3) * shape;
  const double sigma =
      Eigen::JacobiSVD<Eigen::MatrixXd>(gain.asDiagonal() * R).singularValues().minCoeff();
  const double expected = runtime::slowest_time_constant(gain, R, 0.005);
  const double measured = measured_time_constant(puma, gain, 0.005);
  std::printf("gains 0.2 to 3: measured %.4f s, eigenvalue %.4f s, eq. 5.6 %.4f s\n", measured,
              expected, 0.005 / sigma);
  EXPECT_NEAR(measured, expected, 0.03 * expected);
  EXPECT_LT(measured, 0.005 / sigma);
}

TEST(LmsOptions, RefusesWhatCannotBe) {
  const Eigen::VectorXd gain = Eigen::VectorXd::Ones(3);
  EXPECT_NO_THROW(Lms(2, {.gain = gain}));
  EXPECT_THROW(Lms(0, {.gain = gain}), std::invalid_argument);
  EXPECT_THROW(Lms(2, LmsOptions{}), std::invalid_argument);
  EXPECT_THROW(Lms(2, {.gain = -gain}), std::invalid_argument);
  EXPECT_THROW(Lms(2, {.gain = 0 * gain}), std::invalid_argument);
  EXPECT_THROW(Lms(2, {.gain = gain, .joint_weights = Eigen::VectorXd::Ones(3)}),
               std::invalid_argument);
  EXPECT_THROW(Lms(2, {.gain = gain, .start = Eigen::VectorXd::Ones(2)}), std::invalid_argument);
  EXPECT_THROW(Lms(2, {.gain = gain, .normalised = true, .step = 2}), std::invalid_argument);
  EXPECT_THROW(Lms(2, {.gain = gain, .floor = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::test
