// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/likelihood.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

EffectRecordings arm(double seconds) {
  return effect_recordings(
      test::planar_arm(), test::planar_arm_tangents(),
      test::measured({test::sines(seconds, 0.01)}, test::planar_arm_values(), {}, 0.1, 0, 1),
      {1, -1}, {true, true});
}

/// AR(1) noise of both joints.
MatrixXd slow_noise(Index rows, double pole, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  MatrixXd e(rows, 2);
  for (Index j = 0; j < 2; ++j) {
    double x = normal(random) / std::sqrt(1 - pole * pole);
    for (Index k = 0; k < rows; ++k) {
      e(k, j) = x;
      x = pole * x + normal(random);
    }
  }
  return e;
}

TEST(LikelihoodRatio, OfNothingGrowsAsChiSquareDoesWhateverTheNoise) {
  // a column that is not in the noise is fitted to it: the mean of the ratio is its one degree
  const EffectRecordings data = arm(20);
  for (const double pole : {0.0, 0.9}) {
    double sum = 0;
    constexpr int kDraws = 200;
    for (int draw = 0; draw < kDraws; ++draw) {
      const MatrixXd e = slow_noise(data.equations(), pole, 100 + static_cast<unsigned>(draw));
      // white columns: least squares after differencing by the pole is the likely estimate
      VectorXd column(e.rows());
      std::mt19937_64 random(static_cast<unsigned>(draw));
      std::normal_distribution<double> normal;
      for (double& value : column) value = normal(random);
      VectorXd white_column = column, white = e.col(0);
      for (Index k = e.rows() - 1; k > 0; --k) {
        white_column[k] -= pole * column[k - 1];
        white[k] -= pole * e(k - 1, 0);
      }
      MatrixXd fitted = e;
      fitted.col(0) -= white_column.dot(white) / white_column.squaredNorm() * column;
      sum += LikelihoodRatio(data, {e}).of({fitted});
    }
    // one degree has the variance 2
    EXPECT_NEAR(sum / kDraws, 1, 5 * std::sqrt(2.0 / kDraws)) << "pole " << pole;
  }
}

TEST(LikelihoodRatio, SeesAnEffectThatMadeTheNoiseSeemSlow) {
  const EffectRecordings data = arm(20);
  const MatrixXd e = slow_noise(data.equations(), 0, 7);
  MatrixXd with_effect = e;
  for (Index k = 0; k < e.rows(); ++k) {
    with_effect(k, 0) += 20 * std::sin(0.01 * static_cast<double>(k));
  }
  const double ratio = LikelihoodRatio(data, {with_effect}).of({e});
  // one-step prediction takes most of a slow sine: what is left of 46 dB is still far from chance
  EXPECT_GT(ratio, 50);
}

}  // namespace
}  // namespace dyngen::runtime
