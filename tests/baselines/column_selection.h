// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dyngen::test {

/// Columns of unit length at right angles to a model that is fitted anyway, and what it leaves.
struct ColumnSet {
  Eigen::MatrixXd columns;  ///< (equations x any)
  Eigen::VectorXd left;     ///< (equations), whitened as they are
  double equations = 0;     ///< less the model's parameters
};

/// Three simple ways of choosing columns, noise taken as white. Each gives places of columns, by
/// the squares that each takes, falling.
///
/// Least squares with an absolute penalty by coordinate descent (Friedman, Hastie and Tibshirani,
/// Journal of Statistical Software 2010); the penalty by the Bayesian information criterion with
/// the number of equations.
std::vector<Eigen::Index> lasso(const ColumnSet& set);

/// Ridge regression on all columns, of which the small ones are left out until none is (Brunton,
/// Proctor and Kutz, PNAS 2016); what is small by the same criterion.
std::vector<Eigen::Index> thresholded(const ColumnSet& set);

/// The column that lowers the squares most, one after the other, while an F test at 5 % and the
/// criterion with the number of equations agree; twelve at most.
std::vector<Eigen::Index> forward(const ColumnSet& set);

}  // namespace dyngen::test
