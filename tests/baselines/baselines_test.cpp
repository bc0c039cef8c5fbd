// SPDX-License-Identifier: MIT
// The simpler methods, on columns whose answer is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/baselines/column_selection.h"
#include "tests/baselines/friction_ladder.h"
#include "tests/baselines/splines.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd noise(Index count, double deviation, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal(0, deviation);
  return VectorXd::NullaryExpr(count, [&] { return normal(engine); });
}

/// Speeds of a joint that turns often, rad/s.
VectorXd speeds(Index count, double phase) {
  return VectorXd::NullaryExpr(count, [&](Index k) {
    const double t = 0.005 * static_cast<double>(k) + phase;
    return std::sin(2 * t) + 0.4 * std::sin(5.3 * t + 1);
  });
}

constexpr double kStep = 0.005;
constexpr double kFast = 1.2, kReach = 1.5;

MatrixXd base_columns(const VectorXd& dq) {
  MatrixXd base(dq.size(), 3);
  base << VectorXd::Ones(dq.size()), dq, dq.cwiseSign();
  return base;
}

/// Climbs the ladder with a torque beside the base model's; the rung's terms.
std::vector<FrictionTerm> climbed(const std::function<VectorXd(const VectorXd& dq)>& extra,
                                  double deviation) {
  const VectorXd first = speeds(6000, 0), second = speeds(3000, 40);
  const MatrixXd base = base_columns(first), checked_base = base_columns(second);
  const Eigen::ColPivHouseholderQR<MatrixXd> model(base);
  const auto rungs = friction_ladder(kFast, kReach);
  const VectorXd torque =
      base * Eigen::Vector3d(0.3, 2, 1) + extra(first) + noise(6000, deviation, 1);
  const VectorXd checked =
      checked_base * Eigen::Vector3d(0.3, 2, 1) + extra(second) + noise(3000, deviation, 2);
  const VectorXd beta = model.solve(torque);
  std::vector<MatrixXd> columns, checked_columns;
  for (const auto& rung : rungs) {
    MatrixXd own(first.size(), static_cast<Index>(rung.size()));
    MatrixXd other(second.size(), own.cols());
    for (Index i = 0; i < own.cols(); ++i) {
      own.col(i) = friction_column(rung[static_cast<std::size_t>(i)], first, kStep);
      other.col(i) = friction_column(rung[static_cast<std::size_t>(i)], second, kStep);
    }
    const MatrixXd taken = model.solve(own);
    columns.push_back(own - base * taken);
    checked_columns.push_back(other - checked_base * taken);
  }
  return rungs[best_rung(columns, torque - base * beta, checked_columns,
                         checked - checked_base * beta)];
}

TEST(FrictionLadder, StaysOnTheGroundWhereNothingIsLeft) {
  const MatrixXd useless = noise(100, 1, 3);
  const VectorXd left = noise(100, 1, 4), checked = VectorXd::Zero(50);
  EXPECT_EQ(
      best_rung({MatrixXd(100, 0), useless}, left, {MatrixXd(50, 0), noise(50, 1, 5)}, checked),
      0U);
}

TEST(FrictionLadder, FindsEachTermAndItsShape) {
  for (const FrictionTerm& truth :
       {FrictionTerm{FrictionKind::kAsymmetric, 0}, FrictionTerm{FrictionKind::kStribeck, 0.12},
        FrictionTerm{FrictionKind::kCubic, 0}, FrictionTerm{FrictionKind::kPresliding, 0.003}}) {
    const auto rung = climbed(
        [&](const VectorXd& dq) { return (0.5 * friction_column(truth, dq, kStep)).eval(); },
        0.001);
    ASSERT_FALSE(rung.empty()) << family_of(truth);
    const bool there = std::any_of(rung.begin(), rung.end(), [&](const FrictionTerm& term) {
      return term.kind == truth.kind && std::abs(term.shape - truth.shape) < 1e-12;
    });
    EXPECT_TRUE(there) << family_of(truth) << " became " << family_of(rung.back());
  }
}

TEST(FrictionLadder, PreslidingIsExactAtAConstantSpeed) {
  const FrictionTerm term{FrictionKind::kPresliding, 0.01};
  const VectorXd column = friction_column(term, VectorXd::Constant(5, -0.2), kStep);
  for (Index k = 0; k < 5; ++k) {
    const double way = 0.2 * kStep * static_cast<double>(k + 1);
    EXPECT_NEAR(column[k], std::exp(-way / 0.01), 1e-15);
  }
}

TEST(Splines, AddUpToOneAndKeepTheirEnds) {
  const VectorXd x = VectorXd::LinSpaced(101, -1.5, 2.5);
  const MatrixXd columns = cubic_splines(x, -1, 2, 7);
  EXPECT_EQ(columns.cols(), 10);
  EXPECT_LT((columns.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-14);
  EXPECT_EQ(columns.row(0), cubic_splines(VectorXd::Constant(1, -1), -1, 2, 7).row(0));
  EXPECT_EQ(columns.row(100), cubic_splines(VectorXd::Constant(1, 2), -1, 2, 7).row(0));
  EXPECT_THROW(cubic_splines(x, 1, 1, 7), std::invalid_argument);
  EXPECT_THROW(cubic_splines(x, 0, 1, 0), std::invalid_argument);
}

TEST(Splines, ReproduceACubic) {
  const VectorXd x = VectorXd::LinSpaced(200, -1, 2);
  const VectorXd y = 1 - 2 * x.array() + 0.5 * x.array().square() - x.array().cube();
  const MatrixXd A = cubic_splines(x, -1, 2, 5);
  EXPECT_LT((A * ridge_solution(A, y, 0) - y).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Splines, TakeTheirPenaltyFromOtherEquations) {
  const VectorXd x = VectorXd::LinSpaced(400, -1, 1), other = VectorXd::LinSpaced(150, -0.9, 0.9);
  const MatrixXd A = cubic_splines(x, -1, 1, 12), B = cubic_splines(other, -1, 1, 12);
  const auto curve = [](const VectorXd& at) { return (3 * at.array()).sin().matrix().eval(); };
  const double small = penalty_by_validation(A, curve(x), B, curve(other));
  EXPECT_LT((curve(other) - B * ridge_solution(A, curve(x), small)).norm(),
            0.01 * curve(other).norm());
  // nothing but noise: what is added is far smaller than what least squares would add
  const VectorXd first = noise(400, 1, 6), second = noise(150, 1, 7);
  const VectorXd added = B * ridge_solution(A, first, penalty_by_validation(A, first, B, second));
  EXPECT_LE((second - added).norm(), second.norm());
  EXPECT_LT(added.norm(), 0.7 * (B * ridge_solution(A, first, 0)).norm());
}

/// Orthonormal columns, three of which are there.
ColumnSet known_columns() {
  const Index rows = 800;
  MatrixXd columns(rows, 20);
  for (Index c = 0; c < 20; ++c) {
    columns.col(c) = VectorXd::NullaryExpr(rows, [&](Index k) {
      return std::cos(std::numbers::pi * (static_cast<double>(k) + 0.5) *
                      static_cast<double>(c + 1) / static_cast<double>(rows));
    });
    columns.col(c).normalize();
  }
  const VectorXd left =
      20 * columns.col(3) - 40 * columns.col(11) + 10 * columns.col(7) + noise(rows, 1, 8);
  return {columns, left, static_cast<double>(rows)};
}

TEST(ColumnSelection, NamesWhatIsThereByItsSize) {
  const ColumnSet set = known_columns();
  EXPECT_THAT(forward(set), testing::ElementsAre(11, 3, 7));
  EXPECT_THAT(thresholded(set), testing::ElementsAre(11, 3, 7));
  // a penalty that leaves the third in may let small ones in besides
  const auto places = lasso(set);
  ASSERT_GE(places.size(), 3U);
  EXPECT_EQ(places[0], 11);
  EXPECT_EQ(places[1], 3);
  EXPECT_EQ(places[2], 7);
}

TEST(ColumnSelection, NamesLittleOfWhiteNoise) {
  // twenty columns of noise, each with some 1 % by the criterion
  constexpr unsigned kDraws = 100;
  ColumnSet set = known_columns();
  double forward_names = 0, thresholded_names = 0, lasso_names = 0;
  for (unsigned draw = 0; draw < kDraws; ++draw) {
    set.left = noise(set.left.size(), 1, 100 + draw);
    forward_names += static_cast<double>(forward(set).size()) / kDraws;
    thresholded_names += static_cast<double>(thresholded(set).size()) / kDraws;
    lasso_names += static_cast<double>(lasso(set).size()) / kDraws;
  }
  EXPECT_LT(forward_names, 0.5);
  EXPECT_LT(thresholded_names, 0.5);
  EXPECT_LT(lasso_names, 0.5);
}

}  // namespace
}  // namespace dyngen::test
