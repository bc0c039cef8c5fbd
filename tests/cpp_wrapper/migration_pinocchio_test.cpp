// SPDX-License-Identifier: MIT
// docs/howto/cpp_wrapper.md, "From Pinocchio": the right column of the table under the names of the
// left one, held to what Pinocchio's functions promise each other. (Debian has no Pinocchio.)
#include <gtest/gtest.h>

#include "arm.hpp"
#include "loaded_arm.hpp"

namespace {

using Eigen::MatrixXd, Eigen::VectorXd;

constexpr double kTolerance = 1e-12;

/// Code written for Pinocchio, its calls replaced. All arguments and results stay of dynamic size.
VectorXd rnea(const VectorXd& q, const VectorXd& v, const VectorXd& a) {
  return arm::id_rigid(q, v, a);
}
VectorXd computeGeneralizedGravity(const VectorXd& q) { return arm::gravity(q); }
VectorXd nonLinearEffects(const VectorXd& q, const VectorXd& v) {
  return arm::coriolis(q, v) + arm::gravity(q);
}
MatrixXd crba(const VectorXd& q) { return arm::mass_matrix(q); }
MatrixXd computeJointTorqueRegressor(const VectorXd& q, const VectorXd& v, const VectorXd& a) {
  return arm::regressor(q, v, a);
}
Eigen::Isometry3d framePlacement(const VectorXd& q) { return arm::fk(q); }
MatrixXd getFrameJacobian(const VectorXd& q) { return arm::jacobian(q); }
VectorXd rnea(const VectorXd& q, const VectorXd& v, const VectorXd& a,
              const Eigen::Vector3d& gravity_linear, const VectorXd& fext_of_last_link) {
  return loaded_arm::id_rigid(q, v, a, -gravity_linear, fext_of_last_link,
                              loaded_arm::Matrix<10>::Zero(), loaded_arm::chi_values());
}

class FromPinocchio : public testing::Test {
 protected:
  FromPinocchio() {
    q << 0.3, -0.7, 0.5, 1.1, -0.4, 0.9;
    v << -1.2, 0.8, 0.4, -0.6, 1.5, 0.7;
    a << 2.0, -1.0, 0.5, 3.0, -2.0, 1.0;
  }
  VectorXd q{6}, v{6}, a{6};
};

TEST_F(FromPinocchio, TorqueIsMassMatrixTimesAccelerationAndNonLinearEffects) {
  const VectorXd tau = rnea(q, v, a);
  EXPECT_TRUE(tau.isApprox(crba(q) * a + nonLinearEffects(q, v), kTolerance));
  EXPECT_TRUE(nonLinearEffects(q, v).isApprox(rnea(q, v, VectorXd::Zero(6)), kTolerance));
  EXPECT_TRUE(
      nonLinearEffects(q, VectorXd::Zero(6)).isApprox(computeGeneralizedGravity(q), kTolerance));
}

TEST_F(FromPinocchio, RegressorTimesParametersIsTheTorque) {
  const VectorXd tau = computeJointTorqueRegressor(q, v, a) * arm::chi_values();
  EXPECT_TRUE(tau.isApprox(rnea(q, v, a) + arm::friction(v), kTolerance));
}

TEST_F(FromPinocchio, JacobianIsThatOfTheFramesOrigin) {
  const MatrixXd J = getFrameJacobian(q);
  const double h = 1e-6;
  for (int j = 0; j < 6; ++j) {
    const VectorXd step = h * VectorXd::Unit(6, j);
    const Eigen::Isometry3d after = framePlacement(q + step), before = framePlacement(q - step);
    const Eigen::Vector3d velocity = (after.translation() - before.translation()) / (2 * h);
    const Eigen::AngleAxisd turn(after.linear() * before.linear().transpose());
    EXPECT_LT((J.col(j).head<3>() - velocity).norm(), 1e-8);
    EXPECT_LT((J.col(j).tail<3>() - turn.axis() * (turn.angle() / (2 * h))).norm(), 1e-8);
  }
}

TEST_F(FromPinocchio, ForcesFromOutsideTakeTheirWorkFromTheTorque) {
  VectorXd force(6);
  force << 10, -20, 30, 1, 2, -3;
  const Eigen::Vector3d gravity_linear(0, 0, -9.81);
  const Eigen::Matrix3d R = framePlacement(q).linear();
  VectorXd in_base(6);
  in_base << R * force.head<3>(), R * force.tail<3>();
  EXPECT_TRUE(rnea(q, v, a, gravity_linear, force)
                  .isApprox(rnea(q, v, a) - getFrameJacobian(q).transpose() * in_base, kTolerance));
}

}  // namespace
