// SPDX-License-Identifier: MIT
// Short columns are taken out of others as a projection takes them out.
#include "runtime/evidence/local_reflections.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cstdlib>
#include <vector>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index kRows = 120, kReach = 7;

/// Columns of a few rows each, at places that overlap, meet and stand apart; the last is the sum of
/// two of them.
MatrixXd short_columns() {
  std::srand(20261121);
  const std::vector<Index> places = {40, 3, 5, 90, 41, 42, 43, 44, 113};
  MatrixXd columns = MatrixXd::Zero(kRows, static_cast<Index>(places.size()) + 1);
  for (std::size_t i = 0; i < places.size(); ++i) {
    columns.col(static_cast<Index>(i)).segment(places[i], kReach).setRandom();
  }
  columns.rightCols(1) = columns.col(1) - 2 * columns.col(2);
  return columns;
}

MatrixXd projected(const MatrixXd& columns, const MatrixXd& others) {
  return others - columns * columns.completeOrthogonalDecomposition().solve(others);
}

TEST(LocalReflections, LeaveWhatAProjectionLeaves) {
  const MatrixXd columns = short_columns(), others = MatrixXd::Random(kRows, 6);
  const LocalReflections reflections(columns);
  EXPECT_EQ(reflections.rank(), columns.cols() - 1);
  const MatrixXd expected = projected(columns, others);
  MatrixXd turned = others;
  reflections.take_out_of(turned);
  EXPECT_LT((turned.transpose() * turned - expected.transpose() * expected).norm(), 1e-11);
  reflections.turn_back(turned);
  EXPECT_LT((turned - expected).norm(), 1e-11);
}

TEST(LocalReflections, LeaveNothingOfTheirOwnColumns) {
  MatrixXd columns = short_columns();
  const LocalReflections reflections(columns);
  reflections.take_out_of(columns);
  EXPECT_LT(columns.norm(), 1e-12);
}

TEST(LocalReflections, OfNothingChangeNothing) {
  const LocalReflections reflections(MatrixXd::Zero(kRows, 3));
  EXPECT_EQ(reflections.rank(), 0);
  const MatrixXd others = MatrixXd::Random(kRows, 2);
  MatrixXd turned = others;
  reflections.take_out_of(turned);
  EXPECT_EQ(turned, others);
}

}  // namespace
}  // namespace dyngen::runtime
