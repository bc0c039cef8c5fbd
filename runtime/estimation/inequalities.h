// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// x >= 0 with least ||A x - b||.
struct NonNegativeSolution {
  Eigen::VectorXd x;         ///< (n)
  Eigen::VectorXd residual;  ///< (m) b - A x
  bool converged = true;
};

/// @param A  (m x n)       @param b  (m)
/// Source: Lawson and Hanson, "Solving Least Squares Problems", 1974, ch. 23 (NNLS).
NonNegativeSolution nonnegative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Inequalities G x >= h on parameters.
struct Inequalities {
  Eigen::MatrixXd G;  ///< (k x n)
  Eigen::VectorXd h;  ///< (k)
};

struct ConstrainedSolution {
  Eigen::VectorXd x;            ///< (n)
  Eigen::VectorXd multipliers;  ///< (k) not negative; positive where an inequality holds x back
  bool feasible = true;         ///< false: no x fulfils all; x is then the free solution
};

/// x with least ||A x - b|| under G x >= h, exactly: reduced to a least distance, and that to
/// non-negative least squares.
///
/// Columns are scaled to unit norm. Directions that A does not see (below `tolerance` of the
/// largest singular value) keep the values of `start`.
/// @param A  (m x n)       @param b  (m)       @param start  (n)
/// @throws std::invalid_argument  if a size is wrong
/// Source: Lawson and Hanson, "Solving Least Squares Problems", 1974, ch. 23 (LSI, LDP).
ConstrainedSolution constrained_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                              const Inequalities& inequalities,
                                              const Eigen::VectorXd& start,
                                              double tolerance = 1e-9);

}  // namespace dyngen::runtime
