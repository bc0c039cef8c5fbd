// SPDX-License-Identifier: MIT
#include "runtime/excitation/trajectory_basis.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class Basis : public testing::TestWithParam<TrajectoryForm> {
 protected:
  TrajectoryFamily family_{.form = GetParam(), .duration = 7, .harmonics = 4};
};

TEST_P(Basis, BeginsAndEndsAtRestInTheSamePosition) {
  const TrajectoryBasis basis = basis_at(family_, Eigen::Vector2d(0, 7));
  EXPECT_LT(basis.dQ.cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT(basis.ddQ.cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_LT((basis.Q.row(0) - basis.Q.row(1)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(basis.Q.cols(), family_.size());
}

TEST_P(Basis, DerivativesAreThoseOfTheFunctions) {
  const double h = 1e-5;
  const VectorXd time = VectorXd::LinSpaced(40, 0.1, 6.9);
  const TrajectoryBasis basis = basis_at(family_, time);
  const TrajectoryBasis after = basis_at(family_, time.array() + h);
  const TrajectoryBasis before = basis_at(family_, time.array() - h);
  EXPECT_LT(((after.Q - before.Q) / (2 * h) - basis.dQ).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT(((after.dQ - before.dQ) / (2 * h) - basis.ddQ).cwiseAbs().maxCoeff(), 1e-7);
}

TEST_P(Basis, FunctionsAreIndependent) {
  const TrajectoryBasis basis = basis_at(family_, period_times(family_, 200));
  const MatrixXd square = basis.Q.transpose() * basis.Q;
  EXPECT_GT(square.fullPivLu().rcond(), 1e-6);
}

TEST_P(Basis, PullBackIsTheGradient) {
  const TrajectoryBasis basis = basis_at(family_, period_times(family_, 50));
  const MatrixXd x = MatrixXd::Random(family_.size(), 2), step = MatrixXd::Random(x.rows(), 2);
  // s = sum of G * motion is linear: its change is the gradient times the step
  const JointMotion G{MatrixXd::Random(50, 2), MatrixXd::Random(50, 2), MatrixXd::Random(50, 2)};
  const auto s = [&](const MatrixXd& at) {
    const JointMotion motion = basis.motion(at);
    return G.q.cwiseProduct(motion.q).sum() + G.dq.cwiseProduct(motion.dq).sum() +
           G.ddq.cwiseProduct(motion.ddq).sum();
  };
  EXPECT_NEAR(s(x + step) - s(x), basis.pull_back(G).cwiseProduct(step).sum(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Forms, Basis,
                         testing::Values(TrajectoryForm::kFourier, TrajectoryForm::kSpline),
                         [](const auto& form) {
                           return form.param == TrajectoryForm::kFourier ? "Fourier" : "Spline";
                         });

TEST(TrajectoryFamily, RefusesWhatCannotBeginAtRest) {
  EXPECT_THROW((TrajectoryFamily{.harmonics = 1}).validate(), std::invalid_argument);
  EXPECT_THROW((TrajectoryFamily{.duration = 0}).validate(), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
