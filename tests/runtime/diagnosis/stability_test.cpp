// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/stability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "runtime/effects/absorption.h"
#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Noise of an arm's joint 2, in which something is hidden.
class Halves : public testing::Test {
 protected:
  Halves()
      : data_(effect_recordings(
            test::planar_arm(), test::planar_arm_tangents(),
            test::measured({test::sines(40, 0.01)}, test::planar_arm_values(), {}, 0.1, 0, 5),
            {1, -1}, {true, true})),
        left_{residual(data_.runs.front().rows, test::planar_arm_values())} {}

  /// A wave of an angle of joint 2 that is no column of the model.
  [[nodiscard]] VectorXd wave(double times, double phase = 0) const {
    return (times * data_.runs.front().motion.q.col(1).array() + phase).sin();
  }
  [[nodiscard]] std::vector<double> shares(const std::vector<VectorXd>& columns,
                                           const std::vector<double>& prices) const {
    const TorqueNoiseModel noise{quick_noise(white_noise(VectorXd::Constant(2, 0.1)).joints),
                                 VectorXd::Constant(2, 2000), false, VectorXd::Ones(2)};
    const EvidenceSystem system(data_, left_, noise, {});
    std::vector<Contender> contenders;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      contenders.push_back({system.whitened({{1}, {columns[i]}}), prices[i]});
    }
    return selected_shares(system, contenders, 1);
  }

  EffectRecordings data_;
  RunResiduals left_;
};

TEST_F(Halves, AllSayTheTruthWhereItIsApart) {
  left_.front().col(1) += 0.03 * wave(7);
  const std::vector<double> shares = this->shares({wave(7), wave(5), wave(9)}, {8, 8, 8});
  EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 1, 1e-12);
  EXPECT_GT(shares[0], 0.97);
}

TEST_F(Halves, DifferWhereTwoAreAlike) {
  left_.front().col(1) += 0.03 * wave(7, 0.1);
  const std::vector<double> shares = this->shares({wave(7), wave(7, 0.2)}, {8, 8});
  EXPECT_GT(shares[0], 0.1);
  EXPECT_GT(shares[1], 0.1);
}

TEST_F(Halves, PayForParameters) {
  left_.front().col(1) += 0.03 * wave(7, 0.1);
  const std::vector<double> shares = this->shares({wave(7), wave(7, 0.2)}, {40, 8});
  EXPECT_LT(shares[0], 0.05);
}

TEST_F(Halves, AreTheSameTwice) {
  EXPECT_EQ(shares({wave(7), wave(5)}, {8, 8}), shares({wave(7), wave(5)}, {8, 8}));
  EXPECT_TRUE(shares({}, {}).empty());
}

}  // namespace
}  // namespace dyngen::runtime
