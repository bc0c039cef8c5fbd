// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// A covariance as P = U D U', U unit upper triangular, D diagonal: positive definite as long as D
/// is positive, which its updates keep by multiplying with positive numbers only.
///
/// After construction nothing allocates but matrix().
class UdCovariance {
 public:
  /// @param P  (nb x nb) symmetric; positive semidefinite: an entry of D may be 0
  /// @throws std::invalid_argument  if P is not square, finite, symmetric, or has a negative
  ///                                direction; the message begins with `name`
  UdCovariance(const char* name, const Eigen::MatrixXd& P);

  /// Takes in a scalar measurement z = h'x + noise of variance r > 0, in Bierman's form: with f =
  /// U'h, v = D f and a_j = r + sum_(i<=j) v_i f_i, P - P h h' P / a_nb = U (D - v v' / a_nb) U'
  /// has D_j a_(j-1) / a_j on its new diagonal. O(nb^2).
  ///
  /// @param h         (nb)   @param innovation  z - h'x   @param x  (nb) corrected
  /// @return          a_nb = h'P h + r, the variance of the innovation
  double measure(const double* h, double r, double innovation, Eigen::VectorXd& x) noexcept;

  /// P += other, one column of other's U after the other. O(nb^3 / 3) multiplications and additions
  /// each if all entries of other's D are positive; a zero costs nothing.
  void add(const UdCovariance& other) noexcept;

  [[nodiscard]] Eigen::MatrixXd matrix() const;  ///< P. Allocates.
  [[nodiscard]] const Eigen::VectorXd& D() const noexcept { return D_; }
  [[nodiscard]] bool all_finite() const noexcept { return D_.allFinite() && U_.allFinite(); }
  void swap(UdCovariance& other) noexcept;
  /// Takes over the values of one of the same size.
  void assign(const UdCovariance& other) noexcept;

 private:
  Eigen::MatrixXd U_;  // column-major: all work goes along columns
  Eigen::VectorXd D_;
  Eigen::VectorXd f_, v_, gain_, column_;  // scratch
};

}  // namespace dyngen::runtime
