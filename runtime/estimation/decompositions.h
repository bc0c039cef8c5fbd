// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <stdexcept>

namespace dyngen::runtime {

/// Numbers that are not finite, or whose squares are not.
class NotFiniteError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

// Matrices may be empty. Numbers that are not finite are refused: NotFiniteError.

/// A = U diag(values) V', thin; values fall.
struct SingularValues {
  Eigen::MatrixXd U;       ///< (m x k), k = min(m, n)
  Eigen::VectorXd values;  ///< (k)
  Eigen::MatrixXd V;       ///< (n x k)
};

/// By Jacobi's rotations, which find small values as exactly as large ones.
SingularValues decomposed(const Eigen::MatrixXd& A);

/// The values alone. @return (min(m, n))
Eigen::VectorXd singular_values(const Eigen::MatrixXd& A);

/// R of A = Q R by Householder's reflections, with a diagonal that is not negative: unique where
/// A has full rank. Rows below those that A has are 0.
/// @param A  (m x n)       @return (n x n)
Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& A);

/// The same with A as workspace, for blocks of many rows.
Eigen::MatrixXd triangle_in_place(Eigen::MatrixXd& A);

/// X with least ||A X - B||; the shortest of them where A lacks rank.
/// @param tolerance  of the rank, relative; 0: by the size of A and rounding
Eigen::MatrixXd least_norm_solution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B,
                                    double tolerance = 0);

/// The pseudo-inverse of Moore and Penrose, (n x m). @param tolerance  as above
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& A, double tolerance = 0);

/// (n) reciprocal lengths of columns, 1 for those of zeros: A diag(s) has columns of unit length, and
/// which directions are seen does not depend on units.
Eigen::VectorXd unit_scale(const Eigen::MatrixXd& A);

/// Orthonormal directions at right angles to all columns. @param Q  (n x k), orthonormal
/// @return (n x n - k)
Eigen::MatrixXd complement_of(const Eigen::MatrixXd& Q);

}  // namespace dyngen::runtime
