// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/imitation.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <vector>

#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

class ImitationTest : public testing::Test {
 protected:
  ImitationTest()
      : data_(test::arm_recordings(test::two_recordings({}, 1))),
        signals_(data_),
        system_(test::arm_system(data_)) {
    signals_.set_beta(test::planar_arm_values());
  }

  JointColumns whitened(const EffectLaw& law, int joint, const std::vector<double>& parameters,
                        const std::vector<int>& wanted = {0}) {
    return system_.whitened(
        effect_columns(data_, signals_, test::known(law, joint, parameters), wanted));
  }

  /// What the model leaves of columns, all joints below one another.
  [[nodiscard]] MatrixXd left(const JointColumns& columns) const {
    MatrixXd all(2 * system_.rows(), columns.columns());
    all << system_.left_of(columns, 0), system_.left_of(columns, 1);
    return all;
  }

  EffectRecordings data_;
  EffectSignals signals_;
  EvidenceSystem system_;
};

TEST_F(ImitationTest, OfATorqueByItsOwnColumnLeavesNothing) {
  const JointColumns small = whitened(test::spring_law(), 1, {0.4});
  const JointColumns large = whitened(test::spring_law(), 1, {3});
  const Imitation found = imitation(system_, small, large);
  EXPECT_GT(found.whole, 100);
  EXPECT_LT(found.left, 1e-9 * found.whole);
}

TEST_F(ImitationTest, LeavesWhatLeastSquaresLeave) {
  const JointColumns torque = whitened(test::stribeck_law(), 0, {1.5, 0.1});
  const std::vector<JointColumns> others = {
      whitened(test::load_friction_law(), 0, {0.05}), whitened(test::spring_law(), 1, {0.4}),
      whitened(test::ripple_law(), 0, {0.1, 0.05, 21}, {1, 2})};
  const MatrixXd own = left(torque);
  for (const JointColumns& other : others) {
    const MatrixXd columns = left(other);
    const VectorXd rest = own - columns * columns.colPivHouseholderQr().solve(own);
    const Imitation found = imitation(system_, torque, other);
    EXPECT_NEAR(found.whole, own.squaredNorm(), 1e-8 * own.squaredNorm());
    EXPECT_NEAR(found.left, rest.squaredNorm(), 1e-8 * own.squaredNorm());
    EXPECT_GT(found.left, 0.3 * found.whole);
  }
}

/// Joints that share no column of the model imitate nothing of one another; those that do, hardly
/// anything.
TEST_F(ImitationTest, OnAnotherJointLeavesNearlyAll) {
  const JointColumns torque = whitened(test::ripple_law(), 0, {0.1, 0.05, 21});
  const JointColumns other = whitened(test::ripple_law(), 1, {0.1, 0.05, 33});
  const Imitation found = imitation(system_, torque, other);
  EXPECT_GT(found.left, 0.99 * found.whole);
  EXPECT_LE(found.left, found.whole);
}

TEST_F(ImitationTest, OfWhatTheModelAbsorbsIsOfNothing) {
  const JointColumns offset = whitened(test::coulomb_asymmetry_law(), 0, {1.0});
  const Imitation found = imitation(system_, offset, whitened(test::spring_law(), 0, {1}));
  double before = 0;
  for (const MatrixXd& part : offset.parts) before += part.squaredNorm();
  EXPECT_LT(found.whole, 1e-9 * before);
}

}  // namespace
}  // namespace dyngen::runtime
