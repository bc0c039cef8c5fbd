// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::test {

/// Cubic B-splines over equal pieces of a range; beyond it they keep the values of its ends.
/// @param x       (N)      @param low, high  low < high      @param pieces  >= 1
/// @return        (N x pieces + 3), rows add up to 1
/// @throws std::invalid_argument  if the range or the number is not as asked
Eigen::MatrixXd cubic_splines(const Eigen::VectorXd& x, double low, double high, int pieces);

/// minimise ||y - A c||^2 + penalty ||c||^2, columns as they are.
Eigen::VectorXd ridge_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& y, double penalty);

/// The penalty whose fit leaves least of other equations, among 25 over twelve decades about the
/// mean square of a column; infinity where to add nothing leaves less.
double penalty_by_validation(const Eigen::MatrixXd& A, const Eigen::VectorXd& y,
                             const Eigen::MatrixXd& checked_A, const Eigen::VectorXd& checked_y);

}  // namespace dyngen::test
