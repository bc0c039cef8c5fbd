// SPDX-License-Identifier: MIT
#include "runtime/recursive/convergent_mode_lms.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "runtime/recursive/gain.h"
#include "runtime/recursive/lms.h"
#include "tests/runtime/recursive/samples.h"

namespace dyngen::test {
namespace {

using runtime::ConvergentModeLms;
using runtime::ConvergentModeOptions;
using runtime::KeptModes;
using runtime::Lms;

/// The step by the nb x nb eigenproblem of the transition matrix itself: LMS's step in its basis of
/// eigenvectors, all coefficients but one set to zero.
Eigen::VectorXd plain_step(const Eigen::MatrixXd& Y, const Eigen::VectorXd& e,
                           const Eigen::VectorXd& gain) {
  const Eigen::Index nb = gain.size();
  const Eigen::MatrixXd M =
      Eigen::MatrixXd::Identity(nb, nb) - gain.asDiagonal() * (Y.transpose() * Y);
  const Eigen::EigenSolver<Eigen::MatrixXd> modes(M);
  Eigen::Index nearest = 0;
  modes.eigenvalues().cwiseAbs().minCoeff(&nearest);
  const Eigen::MatrixXcd V = modes.eigenvectors();
  const Eigen::VectorXcd step =
      (gain.asDiagonal() * Y.transpose() * e).cast<std::complex<double>>();
  const Eigen::VectorXcd coefficients = V.partialPivLu().solve(step);
  return (V.col(nearest) * coefficients[nearest]).real();
}

TEST(ConvergentModeLms, StepIsThatOfTheWholeTransitionMatrix) {
  const Samples puma = puma3_samples(1, 1.0);
  const Eigen::VectorXd shape = Eigen::VectorXd::LinSpaced(15, 0.2, 3);
  for (const double peak : {0.5, 1.5, 8.0}) {  // 8: the mode is often not the one of largest lambda
    const Eigen::VectorXd gain = peak / runtime::peak_gain(shape, puma.W, 3) * shape;
    ConvergentModeLms lms(3, {.gain = gain});
    for (Eigen::Index k = 0; k < puma.size(); ++k) {
      const Eigen::MatrixXd Y = puma.W.middleRows(3 * k, 3);
      const Eigen::VectorXd before = lms.beta();
      const Eigen::VectorXd e = puma.tau.segment(3 * k, 3) - Y * before;
      ASSERT_TRUE(lms.update(puma.Y(k), puma.torque(k)));
      const Eigen::VectorXd expected = plain_step(Y, e, gain);
      // 1e-9: the plain eigenproblem is of a matrix that is not symmetric, with 12 equal
      // eigenvalues
      EXPECT_LT((lms.beta() - before - expected).norm(), 1e-9 * before.norm() + 1e-9);
      EXPECT_LT(std::abs(lms.mode_eigenvalue()), 1);
    }
  }
}

TEST(ConvergentModeLms, IsLmsWithOneJoint) {
  const Samples samples = random_samples(4, 1, 6, 200, 0.1);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(6);
  const Eigen::VectorXd gain = 1.9 / runtime::peak_gain(ones, samples.W, 1) * ones;
  ConvergentModeLms mode(1, {.gain = gain});
  Lms plain(1, {.gain = gain});
  EXPECT_EQ(feed(mode, samples), 200);
  feed(plain, samples);
  EXPECT_TRUE(mode.beta().isApprox(plain.beta(), 1e-12));
}

TEST(ConvergentModeLms, AllStableModesAreLmsBelowTheBound) {
  const Samples puma = puma3_samples(1, 1.0);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(15);
  const Eigen::VectorXd gain = 1.9 / runtime::peak_gain(ones, puma.W, 3) * ones;
  const Eigen::Vector3d weights(1, 0.3, 0.7);
  ConvergentModeLms all(3,
                        {.gain = gain, .joint_weights = weights, .modes = KeptModes::kAllStable});
  Lms plain(3, {.gain = gain, .joint_weights = weights});
  feed(all, puma, 10);
  feed(plain, puma, 10);
  EXPECT_TRUE(all.beta().isApprox(plain.beta(), 1e-10));
}

TEST(ConvergentModeLms, NoSampleEnlargesTheErrorWhateverTheGain) {
  const Samples puma = puma3_samples(1, 0);
  const Eigen::VectorXd shape = Eigen::VectorXd::LinSpaced(15, 0.2, 3);
  for (const double peak : {1.0, 10.0, 100.0, 1e4}) {
    const Eigen::VectorXd gain = peak / runtime::peak_gain(shape, puma.W, 3) * shape;
    ConvergentModeLms lms(3, {.gain = gain});
    const auto error = [&] {
      return (lms.beta() - puma.beta).cwiseAbs2().cwiseQuotient(gain).sum();
    };
    for (Eigen::Index k = 0; k < puma.size(); ++k) {
      const double before = error();
      lms.update(puma.Y(k), puma.torque(k));
      EXPECT_LE(error(), before * (1 + 1e-12));
    }
  }
}

/// The PUMA with parameters in units that make its regressor's condition 66 instead of 6, 1 N m of
/// noise on torques of 28 N m: distance from the true parameters after `passes` times 100 samples,
/// with one gain for all parameters that makes the strongest sample's Gamma Y'Y `peak`.
struct Distances {
  double plain, mode;
};
Distances distances_after(double peak, int passes, bool poorly_scaled) {
  Samples puma = puma3_samples(1, 1.0);
  if (poorly_scaled) {
    for (Eigen::Index i = 0; i < 15; ++i) {
      const double unit = std::pow(30.0, -static_cast<double>(7 * i % 15) / 14);
      puma.W.col(i) *= unit;
      puma.beta[i] /= unit;
    }
  }
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(15);
  const Eigen::VectorXd gain = peak / runtime::peak_gain(ones, puma.W, 3) * ones;
  Lms plain(3, {.gain = gain});
  ConvergentModeLms mode(3, {.gain = gain});
  feed(plain, puma, passes);
  feed(mode, puma, passes);
  const Distances result{relative_distance(plain.beta(), puma.beta),
                         relative_distance(mode.beta(), puma.beta)};
  std::printf("peak %4.1f, %4d passes, %s scaled: LMS %.3g, convergent mode %.3g\n", peak, passes,
              poorly_scaled ? "poorly" : "well", result.plain, result.mode);
  return result;
}

// What the thesis says of the PUMA (1995, section 7.2.2: LMS did not converge well, LMS along the
// convergent mode did) holds if the gain is too large for some samples, and only then.
TEST(ConvergentModeLms, ConvergesWhereTheGainMakesLmsDiverge) {
  const Distances well = distances_after(10, 10, false);
  EXPECT_GT(well.plain, 1e6);
  EXPECT_LT(well.mode, 0.05);
  for (const int passes : {10, 100, 1000}) EXPECT_GT(distances_after(10, passes, true).plain, 1e3);
  EXPECT_LT(distances_after(10, 1000, true).mode, 0.1);
}

TEST(ConvergentModeLms, IsSlowerThanLmsBelowTheBound) {
  for (const bool poorly_scaled : {false, true}) {
    for (const double peak : {0.5, 1.0, 1.9}) {
      const Distances distances = distances_after(peak, 10, poorly_scaled);
      EXPECT_LT(distances.plain, distances.mode);
    }
  }
}

TEST(ConvergentModeLms, DoesNotCureAPoorlyScaledRegressor) {
  const Distances distances = distances_after(1, 100, true);
  EXPECT_GT(distances.plain, 0.3);
  EXPECT_GT(distances.mode, 0.3);
}

TEST(ConvergentModeLms, LeavesOutSamplesWithoutMotion) {
  const Samples samples = random_samples(7, 2, 3, 1, 0);
  ConvergentModeOptions options{.gain = Eigen::VectorXd::Constant(3, 0.1)};
  options.moving_speed = 0.01;
  ConvergentModeLms lms(2, options);
  const Eigen::Vector2d slow(0.009, -0.01), fast(0, -0.011), bad(1, std::nan(""));
  EXPECT_FALSE(lms.update(samples.Y(0), samples.torque(0), slow.data()));
  EXPECT_FALSE(lms.update(samples.Y(0), samples.torque(0), bad.data()));
  EXPECT_FALSE(lms.update(samples.Y(0), samples.torque(0)));
  EXPECT_EQ(lms.beta(), Eigen::Vector3d::Zero());
  EXPECT_TRUE(lms.update(samples.Y(0), samples.torque(0), fast.data()));
  EXPECT_EQ(lms.samples(), 1);
}

TEST(ConvergentModeLms, PassesOverASampleWithoutAStableMode) {
  const Samples samples = random_samples(8, 2, 3, 1, 0);
  ConvergentModeLms lms(2, {.gain = Eigen::VectorXd::Constant(3, 1e6)});
  EXPECT_FALSE(lms.update(samples.Y(0), samples.torque(0)));
  const double still[6] = {0, 0, 0, 0, 0, 0};
  EXPECT_FALSE(lms.update(still, samples.torque(0)));
  EXPECT_EQ(lms.beta(), Eigen::Vector3d::Zero());
}

TEST(ConvergentModeOptions, RefusesWhatCannotBe) {
  const Eigen::VectorXd gain = Eigen::VectorXd::Ones(3);
  EXPECT_NO_THROW(ConvergentModeLms(12, {.gain = gain}));
  EXPECT_THROW(ConvergentModeLms(13, {.gain = gain}), std::invalid_argument);
  EXPECT_THROW(ConvergentModeLms(2, {.gain = -gain}), std::invalid_argument);
  EXPECT_THROW(ConvergentModeLms(2, {.gain = gain, .moving_speed = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::test
