// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/sandwich_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "runtime/effects/absorption.h"
#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNoise = 0.1;  // N m

/// What is left of an arm's torque, and a column of joint 2 that is there where the joint is slow.
struct Case {
  explicit Case(unsigned seed, const std::vector<EffectInstance>& effects = {})
      : data(effect_recordings(test::planar_arm(), test::planar_arm_tangents(),
                               test::measured({test::sines(40, 0.01)}, test::planar_arm_values(),
                                              effects, kNoise, 0, seed),
                               {1, -1}, {true, true})),
        left{residual(data.runs.front().rows, test::planar_arm_values())} {
    const VectorXd speed = data.runs.front().motion.dq.col(1);
    const double fast = speed.cwiseAbs().maxCoeff();
    slow = (speed.array().abs() < 0.1 * fast).select(speed.cwiseSign(), 0.0);
  }

  [[nodiscard]] SandwichTest scatter() const {
    const TorqueNoiseModel noise{quick_noise(white_noise(VectorXd::Constant(2, kNoise)).joints),
                                 VectorXd::Constant(2, 2000), false, VectorXd::Ones(2)};
    const EvidenceSystem system(data, left, noise, {});
    const JointColumns columns = system.whitened({{1}, {slow}});
    return sandwich_test(system, columns,
                         score_of(system.products(columns, false), false).coefficients);
  }

  EffectRecordings data;
  RunResiduals left;
  VectorXd slow;
};

TEST(SandwichTest, IsWhatEvidenceSaysWhereTheRestIsNoise) {
  std::vector<double> ratios;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Case own(seed);
    own.left.front().col(1) += 0.1 * own.slow;
    const SandwichTest scatter = own.scatter();
    EXPECT_FALSE(scatter.refutes()) << seed;
    ratios.push_back(scatter.here / scatter.squares);
    EXPECT_NEAR(scatter.elsewhere / scatter.squares, 1, 0.4);
  }
  std::sort(ratios.begin(), ratios.end());
  EXPECT_NEAR(ratios[10], 1, 0.2);
}

TEST(SandwichTest, RefutesWhatIsLargeWhereTheRestIs) {
  // friction of any size, stretch by stretch, where the joint is slow in one posture
  std::mt19937_64 random(20261121);
  std::normal_distribution<double> normal;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Case own(seed);
    own.slow.tail(own.slow.size() * 7 / 8).setZero();
    double size = 0;
    for (Index k = 0; k < own.slow.size(); ++k) {
      if (k % 25 == 0) size = 0.3 + normal(random);
      own.left.front()(k, 1) += size * own.slow[k];
    }
    const SandwichTest scatter = own.scatter();
    EXPECT_GT(scatter.squares, 20);  // far more than noise by the evidence
    EXPECT_TRUE(scatter.refutes()) << scatter.here << " and " << scatter.elsewhere;
  }
}

TEST(SandwichTest, OfAnEffectBesideALargerOneStandsByItself) {
  const EffectInstance spring = test::known(test::spring_law(), 1, {2.0});  // not in the model
  Case own(3, {spring});
  own.left.front().col(1) += 0.5 * own.slow;
  const SandwichTest scatter = own.scatter();
  EXPECT_FALSE(scatter.refutes()) << scatter.here << " and " << scatter.elsewhere;
  EXPECT_GT(scatter.elsewhere, 100 * scatter.squares);
}

}  // namespace
}  // namespace dyngen::runtime
