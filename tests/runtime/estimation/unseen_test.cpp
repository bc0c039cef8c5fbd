// SPDX-License-Identifier: MIT
#include "runtime/estimation/unseen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "runtime/estimation/rows.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Two joints, the second one a pendulum on the first, by hand: enough of a robot for names.
/// tau1 = ZZ1 ddq1 + FV1 dq1 + MX2 cos(q2) ddq1; tau2 = MX2 sin(q2) + ZZ2 (ddq1 + ddq2) + FV2 dq2
LinearModel pendulum_on_a_turntable() {
  LinearModel model;
  model.name = "turntable";
  model.joint_names = {"table", "arm"};
  model.revolute = {true, true};
  model.parameters = {{"ZZ1", "kg m^2", "", 1, ParameterKind::kInertial, {}},
                      {"FV1", "N m s/rad", "", 1, ParameterKind::kViscous, {}},
                      {"MX2", "kg m", "", 2, ParameterKind::kInertial, {}},
                      {"ZZ2", "kg m^2", "", 2, ParameterKind::kInertial, {}},
                      {"FV2", "N m s/rad", "", 2, ParameterKind::kViscous, {}}};
  model.columns = {{0, 1, 2}, {2, 3, 4}};
  model.regressor = [](const MatrixXd& q, const MatrixXd& dq, const MatrixXd& ddq, MatrixXd& Y) {
    Y = MatrixXd::Zero(q.rows(), 10);
    Y.col(0) = ddq.col(0);
    Y.col(1) = dq.col(0);
    Y.col(2) = q.col(1).array().cos() * ddq.col(0).array();
    Y.col(5 + 2) = q.col(1).array().sin();
    Y.col(5 + 3) = ddq.col(0) + ddq.col(1);
    Y.col(5 + 4) = dq.col(1);
  };
  return model;
}

std::vector<UnseenCombination> unseen_of(const MatrixXd& q, const MatrixXd& dq,
                                         const MatrixXd& ddq) {
  const LinearModel model = pendulum_on_a_turntable();
  MatrixXd Y;
  model.regressor(q, dq, ddq, Y);
  TorqueFactor factor = empty_factor(model.columns, model.size());
  absorb(factor, Y, MatrixXd::Ones(q.rows(), 2));
  MotionExtent extent;
  extent.add(q, dq, ddq);
  return name_unseen(least_squares(factor, VectorXd::Ones(2)), model, extent);
}

MatrixXd random_matrix(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(50, 2, [&]() { return normal(random); });
}

TEST(Unseen, IsEmptyWhenEverythingMoves) {
  EXPECT_TRUE(unseen_of(random_matrix(1), random_matrix(2), random_matrix(3)).empty());
}

TEST(Unseen, NamesTheJointThatStoodStill) {
  MatrixXd q = random_matrix(1), dq = random_matrix(2), ddq = random_matrix(3);
  q.col(1).setZero();
  dq.col(1).setZero();
  ddq.col(1).setZero();
  const auto combinations = unseen_of(q, dq, ddq);
  // FV2, and MX2 against ZZ1 on joint 1 (cos 0 = 1)
  ASSERT_EQ(combinations.size(), 2U);
  std::vector<std::string> texts = {combinations[0].text, combinations[1].text};
  std::sort(texts.begin(), texts.end());
  EXPECT_EQ(texts[0], "FV2");
  EXPECT_TRUE(texts[1] == "ZZ1 - MX2" || texts[1] == "MX2 - ZZ1") << texts[1];
  for (const UnseenCombination& combination : combinations) {
    EXPECT_NE(combination.advice.find("joint 2 (arm"), std::string::npos) << combination.advice;
  }
}

TEST(Unseen, SaysThatGravityWouldShowIt) {
  MatrixXd q = random_matrix(1), dq = random_matrix(2), ddq = random_matrix(3);
  q.setZero();
  dq.setZero();
  ddq.setZero();
  const auto combinations = unseen_of(q, dq, ddq);
  ASSERT_EQ(combinations.size(), 5U);
  for (const UnseenCombination& combination : combinations) {
    if (combination.text == "MX2") {
      EXPECT_NE(combination.advice.find("gravity"), std::string::npos);
    } else if (combination.text == "FV1") {
      EXPECT_NE(combination.advice.find("constant speed"), std::string::npos);
    } else if (combination.text == "ZZ1") {
      EXPECT_NE(combination.advice.find("faster changes of speed"), std::string::npos);
    }
  }
}

/// tau = ZZ ddq + MX cos(q) + 1e-5 MY cos(q) + FS sign(dq) + OFF: of a joint in a posture that
/// hides MY.
LinearModel joint_in_a_posture() {
  LinearModel model;
  model.name = "joint";
  model.joint_names = {"elbow"};
  model.revolute = {true};
  model.parameters = {{"ZZ", "kg m^2", "", 1, ParameterKind::kInertial, {}},
                      {"MX", "kg m", "", 1, ParameterKind::kInertial, {}},
                      {"MY", "kg m", "", 1, ParameterKind::kInertial, {}},
                      {"FS", "N m", "", 1, ParameterKind::kCoulomb, {}},
                      {"OFF", "N m", "", 1, ParameterKind::kOffset, {}}};
  model.columns = {{0, 1, 2, 3, 4}};
  model.regressor = [](const MatrixXd& q, const MatrixXd& dq, const MatrixXd& ddq, MatrixXd& Y) {
    Y = MatrixXd::Zero(q.rows(), 5);
    Y.col(0) = ddq.col(0);
    Y.col(1) = q.col(0).array().cos();
    Y.col(2) = 1e-5 * Y.col(1);
    Y.col(3) = dq.col(0).array().sign();
    Y.col(4).setOnes();
  };
  return model;
}

// a joint that moves one way in a posture that hides MY
TEST(Seen, NamesSumsOfWhatIsNotSeenAlone) {
  const LinearModel model = joint_in_a_posture();
  const MatrixXd q = random_matrix(1).leftCols(1), ddq = random_matrix(3).leftCols(1);
  const MatrixXd dq = random_matrix(2).leftCols(1).cwiseAbs();
  MatrixXd Y;
  model.regressor(q, dq, ddq, Y);
  const VectorXd truth = (VectorXd(5) << 2, 3, 0.4, 1.5, 0.25).finished();
  TorqueFactor factor = empty_factor(model.columns, model.size());
  absorb(factor, Y, Y * truth);
  const Estimate estimate = least_squares(factor, VectorXd::Ones(1));
  EXPECT_EQ(estimate.rank, 3);
  // what the posture hides takes no part of the torque
  EXPECT_NEAR(estimate.beta[1], truth[1], 1e-4);
  EXPECT_LT(std::abs(estimate.beta[2]), 1e-4);

  const MatrixXd covariance = VectorXd::Constant(5, 0.01).asDiagonal();
  const auto sums = name_seen(estimate, model, estimate.beta, covariance);
  ASSERT_EQ(sums.size(), 1U);
  EXPECT_TRUE(sums[0].text == "FS + OFF" || sums[0].text == "OFF + FS") << sums[0].text;
  EXPECT_NEAR(sums[0].value, 1.75, 1e-9);
  EXPECT_NEAR(sums[0].stddev, std::sqrt(0.02), 1e-12);
  EXPECT_EQ(sums[0].unit, "N m");
  EXPECT_TRUE(std::isnan(name_seen(estimate, model, estimate.beta, {}).front().stddev));

  MotionExtent extent;
  extent.add(q, dq, ddq);
  const auto hidden = name_unseen(estimate, model, extent);
  ASSERT_EQ(hidden.size(), 2U);
  for (const UnseenCombination& own : hidden) {
    if (own.text == "MY") continue;
    EXPECT_TRUE(own.text == "FS - OFF" || own.text == "OFF - FS") << own.text;
    EXPECT_NE(own.advice.find("in both directions"), std::string::npos) << own.advice;
  }
}

TEST(Seen, IsSilentWhereEverythingIsSeen) {
  const LinearModel model = pendulum_on_a_turntable();
  MatrixXd Y;
  model.regressor(random_matrix(1), random_matrix(2), random_matrix(3), Y);
  TorqueFactor factor = empty_factor(model.columns, model.size());
  absorb(factor, Y, MatrixXd::Ones(50, 2));
  const Estimate estimate = least_squares(factor, VectorXd::Ones(2));
  EXPECT_TRUE(name_seen(estimate, model, estimate.beta, {}).empty());
}

TEST(Unseen, SaysWhichJointStands) {
  MatrixXd q = random_matrix(1), dq = random_matrix(2), ddq = random_matrix(3);
  q.col(1).setZero();
  dq.col(1).setZero();
  ddq.col(1).setZero();
  for (const UnseenCombination& combination : unseen_of(q, dq, ddq)) {
    EXPECT_NE(combination.advice.find("joint 2 (arm; it stands)"), std::string::npos)
        << combination.advice;
  }
}

TEST(MotionExtent, MergesAsIfItHadBeenOne) {
  const MatrixXd q = random_matrix(4), dq = random_matrix(5), ddq = random_matrix(6);
  MotionExtent whole, first, second;
  whole.add(q, dq, ddq);
  first.add(q.topRows(20), dq.topRows(20), ddq.topRows(20));
  second.add(q.bottomRows(30), dq.bottomRows(30), ddq.bottomRows(30));
  first.merge(second);
  EXPECT_LT((whole.speed - first.speed).norm(), 1e-13);
  EXPECT_LT((whole.acceleration - first.acceleration).norm(), 1e-13);
  EXPECT_EQ(whole.lowest, first.lowest);
  EXPECT_EQ(whole.highest, first.highest);
}

}  // namespace
}  // namespace dyngen::runtime
