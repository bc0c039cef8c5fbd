// SPDX-License-Identifier: MIT
#include "runtime/excitation/information.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <stdexcept>

#include "runtime/excitation/trajectory_basis.h"
#include "tests/runtime/excitation/small_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// A Fourier motion of two joints, moved on by `step` along a fixed direction.
JointMotion some_motion(Index samples) {
  const TrajectoryFamily family{.duration = 5, .harmonics = 3};
  MatrixXd x(5, 2);
  x << 0.3, -0.2, 0.4, 0.7, -0.5, 0.1, 0.2, 0.6, 0.3, -0.4;
  return basis_at(family, period_times(family, samples)).motion(x);
}

MatrixXd stacked(const LinearModel& model, const JointMotion& motion) {
  MatrixXd Y;
  model.regressor(motion.q, motion.dq, motion.ddq, Y);
  MatrixXd W(2 * motion.q.rows(), 4);
  W << Y.leftCols(4), Y.rightCols(4);
  return W;
}

TEST(Information, IsTheSquareOfTheWeighedRegressor) {
  const LinearModel model = test::small_arm();
  const JointMotion motion = some_motion(60);
  MatrixXd W = stacked(model, motion);
  W.topRows(60) /= 0.5;
  W.bottomRows(60) /= 2;
  MatrixXd prior = MatrixXd::Identity(4, 4);
  const InformationOptions options{
      .torque_noise = Eigen::Vector2d(0.5, 2), .samples = 600, .prior = prior};
  const MatrixXd expected = prior + 10 * W.transpose() * W;
  EXPECT_LT((information_of(model, motion, options).R - expected).cwiseAbs().maxCoeff(), 1e-9);

  InformationOptions part = options;
  part.parameters = {0, 3};
  part.prior.resize(0, 0);
  const MatrixXd R = information_of(model, motion, part).R;
  EXPECT_NEAR(R(0, 1), expected(0, 3), 1e-9);
  EXPECT_NEAR(R(1, 1), expected(3, 3) - 1, 1e-9);
}

TEST(Information, GradientEqualsDifferences) {
  const LinearModel model = test::small_arm();
  const JointMotion motion = some_motion(20);
  const InformationOptions options{.torque_noise = Eigen::Vector2d(0.5, 2),
                                   .parameters = {0, 1, 3}};
  MatrixXd G(3, 3);
  G << 1, 0.3, -0.5, 0.3, 2, 0.1, -0.5, 0.1, -1;
  const auto s = [&](const JointMotion& at) {
    return information_of(model, at, options).R.cwiseProduct(G).sum();
  };
  const JointMotion gradient =
      information_gradient(model, motion, options, information_of(model, motion, options), G);
  const double h = 1e-5;
  for (MatrixXd JointMotion::*part : {&JointMotion::q, &JointMotion::dq, &JointMotion::ddq}) {
    for (const Index sample : {0, 7, 19}) {
      for (Index joint = 0; joint < 2; ++joint) {
        JointMotion after = motion, before = motion;
        (after.*part)(sample, joint) += h;
        (before.*part)(sample, joint) -= h;
        EXPECT_NEAR((s(after) - s(before)) / (2 * h), (gradient.*part)(sample, joint), 1e-6);
      }
    }
  }
}

TEST(Information, ConditionNumberIsThatOfTheStackedRegressor) {
  const LinearModel model = test::small_arm();
  const JointMotion motion = some_motion(60);
  MatrixXd W = stacked(model, motion);
  const auto condition = [](const MatrixXd& matrix) {
    const Eigen::VectorXd values = Eigen::JacobiSVD<MatrixXd>(matrix).singularValues();
    return values[0] / values[values.size() - 1];
  };
  EXPECT_NEAR(condition_number(model, motion, {}), condition(W), 1e-9);
  W.colwise().normalize();
  EXPECT_NEAR(condition_number(model, motion, {}, true), condition(W), 1e-9);
}

TEST(Information, StandardDeviationsAreThoseOfItsInverse) {
  const LinearModel model = test::small_arm();
  const MatrixXd R = information_of(model, some_motion(60), {}).R;
  const Eigen::VectorXd expected = R.inverse().diagonal().cwiseSqrt();
  EXPECT_LT((standard_deviations(R) - expected).cwiseAbs().maxCoeff(), 1e-9);
  MatrixXd unseen = R;
  unseen.row(1).setZero();
  unseen.col(1).setZero();
  EXPECT_TRUE(std::isinf(standard_deviations(unseen)[1]));
  EXPECT_TRUE(std::isfinite(standard_deviations(unseen)[0]));
}

TEST(Information, RefusesWhatDoesNotFitTheModel) {
  const LinearModel model = test::small_arm();
  const JointMotion motion = some_motion(10);
  EXPECT_THROW(information_of(model, motion, {.torque_noise = Eigen::Vector3d(1, 1, 1)}),
               std::invalid_argument);
  EXPECT_THROW(information_of(model, motion, {.torque_noise = Eigen::Vector2d(1, 0)}),
               std::invalid_argument);
  EXPECT_THROW(information_of(model, motion, {.parameters = {2, 1}}), std::invalid_argument);
  EXPECT_THROW(information_of(model, motion, {.parameters = {4}}), std::invalid_argument);
  EXPECT_THROW(information_of(model, motion, {.prior = MatrixXd::Zero(3, 3)}),
               std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
